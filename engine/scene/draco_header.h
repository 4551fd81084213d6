#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace rowland::scene {

/// What a Draco mesh stream claims to hold.
struct DracoCounts {
    std::uint64_t faces = 0;
    std::uint64_t points = 0;
};

/// Reads the counts of a Draco 2.2 mesh stream that may be hostile, without decoding it, and refuses those that the
/// stream is too short to mean: so they can be trusted for allocations of their order. `where` is the file and place
/// for messages. Throws Error (input).
DracoCounts read_draco_counts(std::span<const std::byte> stream, const std::string& where);

}  // namespace rowland::scene
