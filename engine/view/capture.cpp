#include "engine/view/capture.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gpu/lost_context.h"
#include "engine/image/exr.h"
#include "engine/image/png.h"

namespace rowland::view {

namespace {

void require_finite(const std::vector<glm::vec4>& pixels, int width, const std::filesystem::path& path) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const glm::vec4& pixel = pixels[i];
        if (std::isfinite(pixel.r) && std::isfinite(pixel.g) && std::isfinite(pixel.b)) continue;
        const std::size_t columns = static_cast<std::size_t>(width);
        throw Error({.file = path.string(),
                     .location = fmt::format("column {}, row {}", i % columns, i / columns),
                     .found = fmt::format("({}, {}, {})", pixel.r, pixel.g, pixel.b),
                     .expected = "finite radiance",
                     .remedy = "nothing was written; please report the scene",
                     .fault = Fault::System});
    }
}

}  // namespace

std::filesystem::path numbered(const std::filesystem::path& path, int frame, int frames) {
    if (frames == 1) return path;
    std::filesystem::path result = path.parent_path() / path.stem();
    result += fmt::format("_{:04}", frame);
    result += path.extension();
    return result;
}

void write_display_capture(const gpu::Framebuffer& display, const std::filesystem::path& path) {
    const std::vector<std::uint8_t> rgba = display.read_rgba8();
    gpu::require_context();
    std::vector<std::uint8_t> rgb;
    rgb.reserve(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    image::write_png(path, display.size().x, display.size().y, rgb);
    log_info("wrote {}", path.string());
}

void write_linear_capture(const gpu::Framebuffer& linear, const std::filesystem::path& path) {
    const std::vector<glm::vec4> pixels = linear.read_rgba_float();
    gpu::require_context();
    require_finite(pixels, linear.size().x, path);
    const image::Image picture{
        .width = linear.size().x, .height = linear.size().y, .texels = {pixels.begin(), pixels.end()}};
    image::write_exr(path, picture);
    log_info("wrote {}", path.string());
}

}  // namespace rowland::view
