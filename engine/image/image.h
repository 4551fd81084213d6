#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace rowland::image {

/// Linear RGB image, row 0 at the top. Values are as the file holds them: they may be negative, infinite or NaN.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> texels;  ///< width*height, row by row

    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
    }
    const glm::vec3& at(int column, int row) const { return texels[index(column, row)]; }
    glm::vec3& at(int column, int row) { return texels[index(column, row)]; }
};

inline Image make_image(int width, int height) {
    return {
        width, height,
        std::vector<glm::vec3>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), glm::vec3(0.0F))};
}

/// Multiplies every texel.
inline void transform_colours(Image& image, const glm::dmat3& matrix) {
    for (glm::vec3& texel : image.texels) texel = glm::vec3(matrix * glm::dvec3(texel));
}

/// The largest size an image file may claim: 16384 × 8192 texels are the largest panoramas in use, 1.5 GiB as Image.
inline constexpr int kMaximumSide = 32768;
inline constexpr std::uint64_t kMaximumTexels = std::uint64_t{16384} * 8192;
/// Largest image file read (an uncompressed float image of kMaximumTexels and some room).
inline constexpr std::uint64_t kMaximumFileBytes = std::uint64_t{2} << 30;

/// Throws Error (input) naming `file` and `location` if a side is not in [1, kMaximumSide] or there are more than
/// kMaximumTexels texels.
void check_image_size(std::int64_t width, std::int64_t height, const std::string& file, const std::string& location);

/// The memory in bytes that decoding an image file of `file_bytes` bytes may take: 192 bytes for each byte (16 texels
/// of an Image), and at least 400 MiB. The environment variable ROWLAND_IMAGE_MEMORY, in MiB, raises the latter. Throws
/// Error (input) if the variable is out of range.
std::uint64_t decoded_limit(std::uint64_t file_bytes);

/// Throws Error (input) if `decoded_bytes`, all that decoding allocates, exceeds decoded_limit(): a highly compressed
/// file would use memory out of proportion to its size.
void check_decoded_bytes(std::int64_t width, std::int64_t height, std::uint64_t decoded_bytes, std::size_t file_bytes,
                         const std::string& file);

/// Throws Error (input) if the image has more than `texels_per_byte` texels per byte of its file: more than the format
/// can compress, so the file cannot be whole.
void check_compression(std::int64_t width, std::int64_t height, std::size_t file_bytes, std::uint64_t texels_per_byte,
                       const std::string& file);

/// Decodes a Radiance picture (.hdr, .pic): both run-length encodings and flat scanlines, all eight orientations.
/// A texel is mantissa · 2^(exponent − 136), 0 where the exponent is 0 (Radiance itself adds ½ to the mantissa; other
/// programs, and the reference radiances of the tests, do not); values are divided by the header's EXPOSURE and
/// COLORCORR lines and converted from its PRIMARIES, if any, to Rec.709. Throws Error (input) for anything malformed
/// and for sizes over the limits above (checked before allocating); `file` names the bytes in messages.
Image read_radiance_hdr(std::span<const std::byte> bytes, const std::string& file);

/// True if the bytes begin as a Radiance picture does.
bool is_radiance_hdr(std::span<const std::byte> bytes);

/// Reads a Radiance or OpenEXR image, recognised by its first bytes. Throws Error (input).
Image load_image(const std::filesystem::path& path);
/// The same for bytes in memory; `file` names them in messages.
Image decode_image(std::span<const std::byte> bytes, const std::string& file);

}  // namespace rowland::image
