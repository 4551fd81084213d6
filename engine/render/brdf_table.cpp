#include "engine/render/brdf_table.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>

#include "engine/core/parallel.h"
#include "engine/lighting/lobe_nodes.h"

namespace rowland::render {

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

/// Smith visibility × 4 n·l n·v, height-correlated.
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
    const std::vector<glm::vec2> table = bake_brdf_table(kSize);
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
