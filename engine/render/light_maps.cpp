#include "engine/render/light_maps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/lighting/environment_map.h"
#include "engine/lighting/lobe_nodes.h"

namespace rowland::render {

namespace {

gpu::Texture cube_map(const lighting::CubeLayout& layout, const gpu::Sampling& sampling) {
    return gpu::Texture({.kind = gpu::TextureKind::CubeMap,
                         .format = gpu::Format::RGBA16F,
                         .width = layout.face_size,
                         .height = layout.face_size,
                         .levels = layout.levels},
                        sampling);
}

/// A packed map's texels in the working space, still in units of its scale. They get an alpha, which is not read,
/// because drivers copy texels of the texture's own format and convert others.
std::vector<std::uint16_t> to_working_space(std::span<const std::uint16_t> packed, const glm::mat3& to_working) {
    std::vector<std::uint16_t> halves;
    halves.reserve(packed.size() / 3 * 4);
    for (std::size_t i = 0; i + 2 < packed.size(); i += 3) {
        const glm::vec3 rgb(glm::unpackHalf1x16(packed[i]), glm::unpackHalf1x16(packed[i + 1]),
                            glm::unpackHalf1x16(packed[i + 2]));
        // Rec.709 lies inside ACEScg and the matrix's rows sum to 1: no component exceeds the largest of the three.
        const glm::vec3 working = to_working * rgb;
        for (int c = 0; c < 3; ++c) halves.push_back(glm::packHalf1x16(working[c]));
        halves.push_back(0);
    }
    return halves;
}

constexpr int kIrradianceFace = 64;

std::vector<glm::vec3> irradiance_texels(std::span<const lighting::KeyLight> keys, const glm::dmat3& to_working) {
    const lighting::CubeLayout layout{.face_size = kIrradianceFace, .levels = 1};
    const lighting::LobeIrradiance irradiance(keys);
    std::vector<glm::vec3> texels(layout.offset(1));
    parallel_for(std::size_t{6} * kIrradianceFace, [&](std::size_t line) {
        const int face = static_cast<int>(line) / kIrradianceFace;
        const int row = static_cast<int>(line) % kIrradianceFace;
        for (int column = 0; column < kIrradianceFace; ++column) {
            const glm::dvec3 normal = glm::normalize(lighting::cube_direction(
                face, (2.0 * column + 1.0) / kIrradianceFace - 1.0, (2.0 * row + 1.0) / kIrradianceFace - 1.0));
            texels[layout.index(0, face, column, row)] = glm::vec3(to_working * irradiance(normal));
        }
    });
    return texels;
}

}  // namespace

LightMap environment_map(const lighting::LightProbe& probe, const glm::dmat3& rec709_to_working) {
    const lighting::CubeLayout& layout = probe.environment.layout;
    LightMap light{.map = cube_map(layout, {.filter = gpu::Filter::Trilinear}), .scale = probe.environment.scale};
    const std::vector<std::uint16_t> halves = to_working_space(probe.environment.halves, glm::mat3(rec709_to_working));
    for (int level = 0; level < layout.levels; ++level) {
        const std::size_t begin = 4 * layout.offset(level);
        const std::size_t end = 4 * layout.offset(level + 1);
        light.map.upload(std::span(halves).subspan(begin, end - begin), {.level = level, .layers = 6});
    }
    return light;
}

gpu::Texture mirror_map(const lighting::LightProbe& probe, const glm::dmat3& rec709_to_working) {
    const lighting::CubeLayout& layout = probe.environment.layout;
    // A trilinear look-up averages over about twice the width that it is asked for.
    gpu::Texture map =
        cube_map({.face_size = layout.face_size, .levels = 0}, {.filter = gpu::Filter::Trilinear, .level_bias = -1.0F});
    const auto texels = std::span(probe.environment.halves).first(3 * layout.offset(1));
    map.upload(std::span<const std::uint16_t>(to_working_space(texels, glm::mat3(rec709_to_working))), {.layers = 6});
    map.generate_levels();
    return map;
}

LightMap key_irradiance_map(std::span<const lighting::KeyLight> keys, const glm::dmat3& rec709_to_working) {
    LightMap light{.map = cube_map({.face_size = kIrradianceFace, .levels = 1}, {.filter = gpu::Filter::Linear})};
    std::vector<glm::vec3> texels = irradiance_texels(keys, rec709_to_working);
    float largest = 0.0F;
    for (const glm::vec3& texel : texels) largest = std::max({largest, texel.x, texel.y, texel.z});
    if (largest > 0.0F) light.scale = largest;
    for (glm::vec3& texel : texels) texel /= light.scale;
    light.map.upload(std::span<const glm::vec3>(texels), {.layers = 6});
    return light;
}

namespace {

constexpr int kSamples = 256;

float radical_inverse(std::uint32_t bits) {
    bits = (bits << 16U) | (bits >> 16U);
    bits = ((bits & 0x55555555U) << 1U) | ((bits & 0xAAAAAAAAU) >> 1U);
    bits = ((bits & 0x33333333U) << 2U) | ((bits & 0xCCCCCCCCU) >> 2U);
    bits = ((bits & 0x0F0F0F0FU) << 4U) | ((bits & 0xF0F0F0F0U) >> 4U);
    bits = ((bits & 0x00FF00FFU) << 8U) | ((bits & 0xFF00FF00U) >> 8U);
    return static_cast<float>(bits) * 0x1p-32F;
}

/// Half vector distributed as D(h) n·h.
glm::vec3 sample_ggx(float u, float w, float alpha) {
    const float phi = 2.0F * std::numbers::pi_v<float> * u;
    const float cos_theta = std::sqrt((1.0F - w) / (1.0F + (alpha * alpha - 1.0F) * w));
    const float sin_theta = std::sqrt(std::max(0.0F, 1.0F - cos_theta * cos_theta));
    return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
}

/// Smith's height-correlated shadowing and masking, G₂.
float shadowing(float n_l, float n_v, float alpha) {
    const float a2 = alpha * alpha;
    const float l = n_v * std::sqrt(n_l * n_l * (1.0F - a2) + a2);
    const float v = n_l * std::sqrt(n_v * n_v * (1.0F - a2) + a2);
    return 2.0F * n_l * n_v / (l + v);
}

glm::vec2 integrate(float n_v, float roughness) {
    const float alpha = std::max(roughness * roughness, 1e-3F);
    const glm::vec3 v(std::sqrt(1.0F - n_v * n_v), 0.0F, n_v);
    glm::vec2 sum(0.0F);
    for (int i = 0; i < kSamples; ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        const glm::vec3 h = sample_ggx((static_cast<float>(i) + 0.5F) / kSamples, radical_inverse(index), alpha);
        const float v_h = glm::dot(v, h);
        const float n_l = 2.0F * v_h * h.z - v.z;
        if (n_l <= 0.0F || v_h <= 0.0F) continue;
        const float weight = shadowing(n_l, n_v, alpha) * v_h / (h.z * n_v);
        const float fresnel = std::pow(1.0F - v_h, 5.0F);
        sum += glm::vec2(1.0F - fresnel, fresnel) * weight;
    }
    return sum / static_cast<float>(kSamples);
}

}  // namespace

std::vector<glm::vec2> bake_brdf_table(int size) {
    const auto count = static_cast<std::size_t>(size);
    std::vector<glm::vec2> table(count * count);
    parallel_for(count, [&](std::size_t row) {
        const float roughness = (static_cast<float>(row) + 0.5F) / static_cast<float>(size);
        for (std::size_t column = 0; column < count; ++column)
            table[row * count + column] =
                integrate((static_cast<float>(column) + 0.5F) / static_cast<float>(size), roughness);
    });
    return table;
}

gpu::Texture brdf_texture() {
    constexpr int kSize = 64;
    gpu::Texture texture({.format = gpu::Format::RG16F, .width = kSize, .height = kSize});
    static const std::vector<glm::vec2> table = bake_brdf_table(kSize);
    texture.upload(std::span<const float>(&table[0].x, 2 * table.size()));
    return texture;
}

gpu::Texture lobe_nodes_texture() {
    using lighting::LobeNodeTable;
    gpu::Texture texture({.kind = gpu::TextureKind::Plane,
                          .format = gpu::Format::RGBA32F,
                          .width = LobeNodeTable::kColumns,
                          .height = LobeNodeTable::kPlanes * LobeNodeTable::kRows});
    texture.upload(std::span<const glm::vec4>(lighting::lobe_node_table().texels));
    return texture;
}

}  // namespace rowland::render
