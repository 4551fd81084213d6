#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rowland::fuzz {

/// A file as damage, malice or a poor exporter make it: one to four of bit flips, truncation, counts of any size in
/// place of others (binary and written out), pieces doubled, removed or exchanged, brackets opened ten thousand deep.
/// The same number gives the same file everywhere. At most `bytes` and 64 KiB.
std::vector<std::byte> mutate(std::span<const std::byte> bytes, std::uint64_t number);

}  // namespace rowland::fuzz
