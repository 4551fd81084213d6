#include "engine/image/load.h"

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/exr.h"
#include "engine/image/limits.h"
#include "engine/image/radiance_hdr.h"

namespace rowland::image {

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
