#include "modules/diffraction/runtime/groove_map.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "engine/core/error.h"
#include "engine/render/draw_list.h"
#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

namespace {

scene::TextureUse texture_use(const GrooveTexture& use, const scene::ImportedScene& scene, const std::string& file,
                              const std::string& pointer) {
    const auto index = static_cast<std::size_t>(use.index);
    scene::require_texture(scene, index, file, pointer);
    if (use.tex_coord > 1)
        refuse_input(file, pointer + "/texCoord", fmt::format("{}", use.tex_coord),
                     "0 or 1: only two sets of texture coordinates are supported");
    return {.texture = index,
            .uv_set = use.tex_coord,
            .transform = {.offset = glm::vec2(use.offset),
                          .rotation = static_cast<float>(use.rotation),
                          .scale = glm::vec2(use.scale)}};
}

/// The column or row of an image after wrapping.
int wrapped(int index, int size, scene::TextureWrap wrap) {
    if (wrap == scene::TextureWrap::Clamp) return std::clamp(index, 0, size - 1);
    const int period = wrap == scene::TextureWrap::Mirror ? 2 * size : size;
    const int within = (index % period + period) % period;
    return within < size ? within : period - 1 - within;
}

}  // namespace

GrooveMap::GrooveMap(const GrooveTexture& use, render::SurfaceTextures& textures, const std::string& file,
                     const std::string& pointer) {
    const scene::ImportedScene& scene = textures.scene();
    use_ = texture_use(use, scene, file, pointer);
    sparkle_ = use.sparkle;
    sampling_ = scene.textures[static_cast<std::size_t>(use.index)];
    image_ = scene.images[sampling_.image];
    for (std::size_t i = 1; i < image_->rgba.size(); i += 4) gaps_ = gaps_ || image_->value(i) == 0.0;
    pitches_ = groove_pitches(*image_);
}

double GrooveMap::red(int column, int row) const {
    const int x = wrapped(column, image_->width, sampling_.wrap_s);
    const int y = wrapped(row, image_->height, sampling_.wrap_t);
    return image_->value(
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_->width) + static_cast<std::size_t>(x)));
}

double GrooveMap::rotation(const glm::vec2& uv) const {
    const render::UvTransform transform = render::uv_transform(use_.transform);
    const glm::vec2 texture_uv = glm::vec2(transform.linear) * uv.x +
                                 glm::vec2(transform.linear.z, transform.linear.w) * uv.y + transform.offset;
    // Against overflow; coordinates beyond a million repeats are meaningless.
    const auto texels = [](float coordinate, int size) {
        return std::clamp(static_cast<double>(coordinate), -1e6, 1e6) * size;
    };
    const double x = texels(texture_uv.x, image_->width);
    const double y = texels(texture_uv.y, image_->height);
    if (sampling_.nearest)
        return std::numbers::pi * red(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
    const int column = static_cast<int>(std::floor(x - 0.5));
    const int row = static_cast<int>(std::floor(y - 0.5));
    const double s = x - 0.5 - column;
    const double t = y - 0.5 - row;
    return std::numbers::pi * ((1.0 - t) * ((1.0 - s) * red(column, row) + s * red(column + 1, row)) +
                               t * ((1.0 - s) * red(column, row + 1) + s * red(column + 1, row + 1)));
}

const gpu::Texture& GrooveMap::moments(bool even) const {
    std::optional<gpu::Texture>& made = moments_[even ? 1 : 0];
    if (made) return *made;
    const bool levels = sampling_.mipmaps && !sampling_.nearest && !sparkle_;
    gpu::Sampling sampling = render::sampling_of(sampling_);
    // Software renderers average far more than a pixel when they filter anisotropically.
    sampling.anisotropy = 1.0F;
    if (sparkle_) sampling.filter = gpu::Filter::Nearest;
    made.emplace(
        gpu::TextureDesc{
            .format = gpu::Format::RGBA16, .width = image_->width, .height = image_->height, .levels = levels ? 0 : 1},
        sampling);
    made->upload(std::span<const std::uint16_t>(
        groove_moments(*image_, {.even = even, .gaps = gaps_, .smallest_pitch = pitches_.smallest})));
    if (levels) made->generate_levels();
    return *made;
}

void GrooveMap::add_defines(bool even, gpu::ProgramDesc& desc) const {
    desc.defines.push_back({"GROOVE_MAP", use_.uv_set == 1 ? "uv1" : "uv"});
    desc.defines.push_back({use_.uv_set == 1 ? "HAS_UV1" : "HAS_UV", ""});
    if (even) desc.defines.push_back({"GROOVES_EVEN", "1"});
    if (gaps_) desc.defines.push_back({"GROOVE_GAPS", "1"});
}

void GrooveMap::bind(bool even, const gpu::Program& program) const {
    moments(even).bind(kGrooveMapUnit);
    const render::UvTransform transform = render::uv_transform(use_.transform);
    program.set("groove_uv_linear", transform.linear);
    program.set("groove_uv_offset", transform.offset);
    program.set("groove_pitch", static_cast<float>(pitches_.smallest));
}

scene::Mesh turned_by(const GrooveMap& grooves, const scene::Mesh& mesh) {
    const std::vector<glm::vec2>& uvs = grooves.uv_set() == 1 ? mesh.uvs1 : mesh.uvs;
    scene::Mesh turned = mesh;
    for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
        const double angle = grooves.rotation(i < uvs.size() ? uvs[i] : glm::vec2(0.0F));
        const glm::vec3 g(mesh.tangents[i]);
        const glm::vec3 bitangent = mesh.tangents[i].w * glm::cross(mesh.normals[i], g);
        turned.tangents[i] =
            glm::vec4(static_cast<float>(std::cos(angle)) * g + static_cast<float>(std::sin(angle)) * bitangent,
                      mesh.tangents[i].w);
    }
    return turned;
}

namespace {

std::uint16_t normalised(double value) {
    return static_cast<std::uint16_t>(std::lround(65535.0 * value));
}

std::array<std::uint16_t, 4> moments_of(double red, double green, const GrooveMomentUse& use) {
    if (green == 0.0) return {normalised(0.5), normalised(0.5), 0, 0};
    const double angle = (use.even ? 2.0 : 1.0) * std::numbers::pi * red;
    const double inverse = std::min(use.smallest_pitch / (2.0 * green), 1.0);
    return {normalised(0.5 + 0.5 * std::cos(angle)), normalised(0.5 + 0.5 * std::sin(angle)), normalised(inverse),
            normalised(use.gaps ? 1.0 : inverse * inverse)};
}

}  // namespace

std::vector<std::uint16_t> groove_moments(const image::ByteImage& image, const GrooveMomentUse& use) {
    std::vector<std::uint16_t> moments;
    moments.reserve(image.rgba.size());
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        for (const std::uint16_t moment : moments_of(image.value(i), image.value(i + 1), use))
            moments.push_back(moment);
    return moments;
}

}  // namespace rowland::diffraction
