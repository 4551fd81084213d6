#include "tests/unit/engine/image/image_bytes.h"

#include <turbojpeg.h>

#include <stdexcept>

namespace rowland::test {

namespace {

std::vector<std::byte> encoded(int width, int height, int format, std::span<const std::uint8_t> values) {
    tjhandle encoder = tjInitCompress();
    unsigned char* data = nullptr;
    unsigned long size = 0;
    const int status = tjCompress2(encoder, values.data(), width, 0, height, format, &data, &size, TJSAMP_444, 100,
                                   TJFLAG_ACCURATEDCT);
    std::vector<std::byte> bytes;
    if (status == 0) {
        const auto* begin = reinterpret_cast<const std::byte*>(data);
        bytes.assign(begin, begin + size);
    }
    tjFree(data);
    tjDestroy(encoder);
    if (status != 0) throw std::runtime_error("the test's JPEG could not be encoded");
    return bytes;
}

}  // namespace

std::vector<std::byte> encoded_jpeg(int width, int height, std::span<const std::uint8_t> rgb) {
    return encoded(width, height, TJPF_RGB, rgb);
}

std::vector<std::byte> encoded_cmyk_jpeg(int width, int height, std::span<const std::uint8_t> cmyk) {
    return encoded(width, height, TJPF_CMYK, cmyk);
}

}  // namespace rowland::test
