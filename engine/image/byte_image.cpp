#include "engine/image/byte_image.h"

#include "engine/core/error.h"
#include "engine/image/jpeg_decode.h"
#include "engine/image/png_decode.h"

namespace rowland::image {

namespace {

[[noreturn]] void refuse_format(std::span<const std::byte> bytes, const std::string& file) {
    refuse_input(file, "", bytes.empty() ? "an empty image" : "an unknown image format", "PNG or JPEG",
                 "convert the image to one of them");
}

}  // namespace

ByteImageSize byte_image_size(std::span<const std::byte> bytes, const std::string& file) {
    if (is_png(bytes)) return png_size(bytes, file);
    if (is_jpeg(bytes)) return jpeg_size(bytes, file);
    refuse_format(bytes, file);
}

ByteImage decode_byte_image(std::span<const std::byte> bytes, const std::string& file) {
    if (is_png(bytes)) return decode_png(bytes, file);
    if (is_jpeg(bytes)) return decode_jpeg(bytes, file);
    refuse_format(bytes, file);
}

}  // namespace rowland::image
