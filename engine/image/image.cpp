#include "engine/image/image.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/exr.h"

namespace rowland::image {

namespace {

constexpr const char* kMemoryVariable = "ROWLAND_IMAGE_MEMORY";
constexpr std::uint64_t kMebibyte = 1 << 20;
constexpr std::uint64_t kDecodedBytesPerByte = 192;

}  // namespace

void check_image_size(std::int64_t width, std::int64_t height, const std::string& file, const std::string& location) {
    const bool sides_fit = width >= 1 && height >= 1 && width <= kMaximumSide && height <= kMaximumSide;
    if (sides_fit && static_cast<std::uint64_t>(width * height) <= kMaximumTexels) return;
    refuse_input(file, location, fmt::format("an image of {} x {} texels", width, height),
                 fmt::format("sides in [1, {}] and at most {} texels", kMaximumSide, kMaximumTexels),
                 "scale the image down");
}

std::uint64_t decoded_limit(std::uint64_t file_bytes) {
    return std::max(memory_limit(kMemoryVariable, 400, 1 << 20), kDecodedBytesPerByte * file_bytes);
}

void check_decoded_bytes(std::int64_t width, std::int64_t height, std::uint64_t decoded_bytes, std::size_t file_bytes,
                         const std::string& file) {
    const std::uint64_t limit = decoded_limit(file_bytes);
    if (decoded_bytes <= limit) return;
    refuse_input(
        file, "",
        fmt::format("an image of {} x {} texels in {} bytes, which takes {} MiB to decode", width, height, file_bytes,
                    decoded_bytes / kMebibyte),
        fmt::format("at most {} MiB for a file of this size", limit / kMebibyte),
        fmt::format("scale the image down, or allow more MiB by the environment variable {}", kMemoryVariable));
}

void check_compression(std::int64_t width, std::int64_t height, std::size_t file_bytes, std::uint64_t texels_per_byte,
                       const std::string& file) {
    if (static_cast<std::uint64_t>(width * height) / texels_per_byte <= file_bytes) return;
    refuse_input(file, "", fmt::format("an image of {} x {} texels in {} bytes", width, height, file_bytes),
                 "the whole image", "export the image again");
}

Image load_image(const std::filesystem::path& path) {
    return decode_image(read_file(path, kMaximumFileBytes), path.string());
}

Image decode_image(std::span<const std::byte> bytes, const std::string& file) {
    if (is_radiance_hdr(bytes)) return read_radiance_hdr(bytes, file);
    if (is_exr(bytes)) return read_exr(bytes, file);
    refuse_input(file, "byte 0", bytes.empty() ? "an empty file" : "an unknown image format",
                 "Radiance (.hdr) or OpenEXR (.exr)", "convert the image to one of them");
}

}  // namespace rowland::image
