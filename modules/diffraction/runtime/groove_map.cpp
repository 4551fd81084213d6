#include "modules/diffraction/runtime/groove_map.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <span>

#include "engine/core/error.h"
#include "engine/render/draw_list.h"
#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

namespace {

constexpr std::uint16_t kHalfMoment = 32768;  ///< of a texel without a grating

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

/// The mean area of facets of one direction each: the inverse of the fractions of texels whose grooves are not those of
/// the texel before them, along rows and along columns.
double facet_texels(const image::ByteImage& image) {
    const auto texel = [&](int column, int row) {
        return 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                    static_cast<std::size_t>(column));
    };
    double area = 1.0;
    for (const bool along_rows : {true, false}) {
        std::size_t pairs = 0;
        std::size_t different = 0;
        for (int row = along_rows ? 0 : 1; row < image.height; ++row)
            for (int column = along_rows ? 1 : 0; column < image.width; ++column) {
                const std::size_t here = texel(column, row);
                const std::size_t before = along_rows ? texel(column - 1, row) : texel(column, row - 1);
                if (image.value(here + 1) == 0.0 || image.value(before + 1) == 0.0) continue;
                ++pairs;
                if (image.value(here) != image.value(before)) ++different;
            }
        area *= static_cast<double>(std::max<std::size_t>(pairs, 1)) /
                static_cast<double>(std::max<std::size_t>(different, 1));
    }
    return area;
}

/// The next level of the moments of facets, from a level of this size: of four texels the grooves of one, drawn at
/// random among those that have a grating, and with `gaps` the mean coverage.
std::vector<std::uint16_t> facets_of_level(const std::vector<std::uint16_t>& from, const glm::ivec2& size, bool gaps) {
    const glm::ivec2 half = glm::max(size / 2, 1);
    std::vector<std::uint16_t> to;
    to.reserve(4 * static_cast<std::size_t>(half.x) * static_cast<std::size_t>(half.y));
    std::minstd_rand random;  // the same numbers everywhere
    for (int row = 0; row < half.y; ++row)
        for (int column = 0; column < half.x; ++column) {
            std::array<const std::uint16_t*, 4> covered{};
            std::size_t count = 0;
            double coverage = 0.0;
            for (int i = 0; i < 4; ++i) {
                const int x = std::min(2 * column + i % 2, size.x - 1);
                const int y = std::min(2 * row + i / 2, size.y - 1);
                const std::uint16_t* texel = &from[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                                                        static_cast<std::size_t>(x))];
                if (texel[2] == 0) continue;
                covered.at(count++) = texel;
                coverage += gaps ? texel[3] / 4.0 : 0.25 * 65535.0;
            }
            if (count == 0) {
                to.insert(to.end(), {kHalfMoment, kHalfMoment, 0, 0});
                continue;
            }
            const std::uint16_t* chosen = covered.at(random() / 8U % count);  // the lowest bits are the least random
            const double ratio = gaps ? coverage / chosen[3] : 1.0;
            for (std::size_t c = 0; c < 4; ++c) {
                const double middle = c < 2 ? kHalfMoment : 0.0;
                const double scaled = c == 3 && !gaps ? chosen[3] : middle + ratio * (chosen[c] - middle);
                to.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(scaled, 0.0, 65535.0))));
            }
        }
    return to;
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
    // Software renderers average far more than a pixel when they filter anisotropically.
    sampling.anisotropy = 1.0F;
    if (sparkle_) sampling.filter = gpu::Filter::Nearest;
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
