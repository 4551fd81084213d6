#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/core/hash.h"

namespace rowland::cook {

/// No source is larger; a sparse file of terabytes must not keep a cook busy for hours.
inline constexpr std::uint64_t kMaximumSourceBytes = std::uint64_t{1} << 30;

/// Content hash of a file, or nothing if it is no regular file, unreadable or larger than kMaximumSourceBytes.
std::optional<Hash128> hash_file(const std::filesystem::path& path);

/// Throws Error (system): a file is not what it was when the cook first saw it.
[[noreturn]] void fail_changed(const std::filesystem::path& path);

/// The first `size` bytes of a file, or all of a shorter one. Throws Error (input) for what no loader must be given:
/// an empty file, a folder, a pipe, a device, a file that cannot be read.
std::vector<std::byte> read_beginning(const std::filesystem::path& path, std::size_t size);

}  // namespace rowland::cook
