#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace rowland::image {

/// What an image file may claim, so that a few hostile bytes cannot make us swallow memory: 16384 × 8192 texels, the
/// largest panoramas in use, are 1.5 GiB as Image.
inline constexpr int kMaximumSide = 32768;
inline constexpr std::uint64_t kMaximumTexels = std::uint64_t{16384} * 8192;
/// Largest image file read (an uncompressed float image of kMaximumTexels and some room).
inline constexpr std::uint64_t kMaximumFileBytes = std::uint64_t{2} << 30;

/// Throws Error (input) naming `file` and `place` if a side is not in [1, kMaximumSide] or there are more than
/// kMaximumTexels texels.
void check_image_size(std::int64_t width, std::int64_t height, const std::string& file, const std::string& place);

/// Throws Error (input) if more than `texels_per_byte` texels would have to come from each of `length` bytes, more than
/// the format can compress: so that a few bytes cannot make us allocate a large image that cannot be in them.
void check_compression(std::int64_t width, std::int64_t height, std::size_t length, std::uint64_t texels_per_byte,
                       const std::string& file);

}  // namespace rowland::image
