#include "modules/diffraction/runtime/groove_map.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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
    if (sparkle_) facet_texels_ = facet_texels(*image_);
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
    const bool levels = sparkle_ || (sampling_.mipmaps && !sampling_.nearest);
    gpu::Sampling sampling = render::sampling_of(sampling_);
    if (sparkle_) {
        sampling.filter = gpu::Filter::Nearest;
        sampling.anisotropy = 1.0F;
    }
    made.emplace(
        gpu::TextureDesc{
            .format = gpu::Format::RGBA16, .width = image_->width, .height = image_->height, .levels = levels ? 0 : 1},
        sampling);
    std::vector<std::uint16_t> texels =
        groove_moments(*image_, {.even = even, .gaps = gaps_, .smallest_pitch = pitches_.smallest});
    made->upload(std::span<const std::uint16_t>(texels));
    if (levels && !sparkle_) made->generate_levels();
    for (int level = 1; sparkle_ && level < made->levels(); ++level) {
        texels = facets_of_level(texels, made->size(level - 1), gaps_);
        made->upload(std::span<const std::uint16_t>(texels), {.level = level});
    }
    return *made;
}

void GrooveMap::add_defines(bool even, gpu::ProgramDesc& desc) const {
    desc.defines.push_back({"GROOVE_MAP", use_.uv_set == 1 ? "uv1" : "uv"});
    desc.defines.push_back({use_.uv_set == 1 ? "HAS_UV1" : "HAS_UV", ""});
    if (even) desc.defines.push_back({"GROOVES_EVEN", "1"});
    if (gaps_) desc.defines.push_back({"GROOVE_GAPS", "1"});
    if (sparkle_) desc.defines.push_back({"GROOVE_SPARKLE", "\"modules/diffraction/shaders/sparkle.glsl\""});
}

void GrooveMap::bind(bool even, const gpu::Program& program) const {
    moments(even).bind(kGrooveMapUnit);
    const render::UvTransform transform = render::uv_transform(use_.transform);
    program.set("groove_uv_linear", transform.linear);
    program.set("groove_uv_offset", transform.offset);
    program.set("groove_pitch", static_cast<float>(pitches_.smallest));
    if (sparkle_) program.set("facet_texels", static_cast<float>(facet_texels_));
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

}  // namespace rowland::diffraction
