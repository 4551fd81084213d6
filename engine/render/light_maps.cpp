#include "engine/render/light_maps.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/lighting/environment_map.h"

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

/// A packed map's texels in the working space, still in units of its scale, with an alpha that is not read: drivers
/// copy texels that have the texture's own format, and convert others.
std::vector<std::uint16_t> to_working_space(std::span<const std::uint16_t> packed, const glm::mat3& to_working) {
    std::vector<std::uint16_t> halves;
    halves.reserve(packed.size() / 3 * 4);
    for (std::size_t i = 0; i + 2 < packed.size(); i += 3) {
        const glm::vec3 rgb(glm::unpackHalf1x16(packed[i]), glm::unpackHalf1x16(packed[i + 1]),
                            glm::unpackHalf1x16(packed[i + 2]));
        // Rec.709 lies inside ACEScg and its rows sum to 1: no component exceeds the largest of the three.
        const glm::vec3 working = to_working * rgb;
        for (int c = 0; c < 3; ++c) halves.push_back(glm::packHalf1x16(working[c]));
        halves.push_back(0);
    }
    return halves;
}

constexpr int kIrradianceFace = 64;

std::vector<glm::vec3> irradiance_texels(std::span<const lighting::KeyLight> keys, const glm::dmat3& to_working) {
    const lighting::CubeLayout layout{.face_size = kIrradianceFace, .levels = 1};
    std::vector<glm::vec3> texels(layout.offset(1));
    parallel_for(std::size_t{6} * kIrradianceFace, [&](std::size_t line) {
        const int face = static_cast<int>(line) / kIrradianceFace;
        const int row = static_cast<int>(line) % kIrradianceFace;
        for (int column = 0; column < kIrradianceFace; ++column) {
            const glm::dvec3 normal = glm::normalize(lighting::cube_direction(
                face, (2.0 * column + 1.0) / kIrradianceFace - 1.0, (2.0 * row + 1.0) / kIrradianceFace - 1.0));
            glm::dvec3 sum(0.0);
            for (const lighting::KeyLight& key : keys) sum += lighting::irradiance(key, normal);
            texels[layout.index(0, face, column, row)] = glm::vec3(to_working * sum);
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

}  // namespace rowland::render
