#include "engine/render/key_irradiance.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/lighting/environment_map.h"

namespace rowland::render {

namespace {

constexpr int kFaceSize = 64;

std::vector<glm::vec3> irradiance_texels(std::span<const lighting::KeyLight> keys, const glm::dmat3& to_working) {
    const lighting::CubeLayout layout{.face_size = kFaceSize, .levels = 1};
    std::vector<glm::vec3> texels(layout.offset(1));
    parallel_for(std::size_t{6} * kFaceSize, [&](std::size_t line) {
        const int face = static_cast<int>(line) / kFaceSize;
        const int row = static_cast<int>(line) % kFaceSize;
        for (int column = 0; column < kFaceSize; ++column) {
            const glm::dvec3 normal = glm::normalize(lighting::cube_direction(
                face, (2.0 * column + 1.0) / kFaceSize - 1.0, (2.0 * row + 1.0) / kFaceSize - 1.0));
            glm::dvec3 sum(0.0);
            for (const lighting::KeyLight& key : keys) sum += lighting::irradiance(key, normal);
            texels[layout.index(0, face, column, row)] = glm::vec3(to_working * sum);
        }
    });
    return texels;
}

float largest_component(std::span<const glm::vec3> texels) {
    float largest = 0.0F;
    for (const glm::vec3& texel : texels) largest = std::max({largest, texel.x, texel.y, texel.z});
    return largest;
}

}  // namespace

KeyIrradiance::KeyIrradiance(std::span<const lighting::KeyLight> keys, const glm::dmat3& rec709_to_working)
    : map_({.kind = gpu::TextureKind::CubeMap, .format = gpu::Format::RGBA16F, .width = kFaceSize, .height = kFaceSize},
           {.filter = gpu::Filter::Linear}) {
    std::vector<glm::vec3> texels = irradiance_texels(keys, rec709_to_working);
    const float largest = largest_component(texels);
    if (largest > 0.0F) scale_ = largest;
    for (glm::vec3& texel : texels) texel /= scale_;
    map_.upload(std::span<const glm::vec3>(texels), {.layers = 6});
}

}  // namespace rowland::render
