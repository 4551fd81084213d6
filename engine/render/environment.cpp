#include "engine/render/environment.h"

#include <glm/gtc/packing.hpp>
#include <vector>

namespace rowland::render {

namespace {

/// The packed map's texels in the working space, still in units of its scale.
std::vector<std::uint16_t> to_working_space(const lighting::PackedEnvironmentMap& packed, const glm::mat3& to_working) {
    std::vector<std::uint16_t> halves(packed.halves.size());
    for (std::size_t i = 0; i + 2 < halves.size(); i += 3) {
        const glm::vec3 rgb(glm::unpackHalf1x16(packed.halves[i]), glm::unpackHalf1x16(packed.halves[i + 1]),
                            glm::unpackHalf1x16(packed.halves[i + 2]));
        // Rec.709 lies inside ACEScg and its rows sum to 1: no component exceeds the largest of the three.
        const glm::vec3 working = to_working * rgb;
        for (int c = 0; c < 3; ++c) halves[i + static_cast<std::size_t>(c)] = glm::packHalf1x16(working[c]);
    }
    return halves;
}

}  // namespace

Environment::Environment(const lighting::LightProbe& probe, const glm::dmat3& rec709_to_working)
    : map_({.kind = gpu::TextureKind::CubeMap,
            .format = gpu::Format::RGBA16F,
            .width = probe.environment.layout.face_size,
            .height = probe.environment.layout.face_size,
            .levels = probe.environment.layout.levels},
           {.filter = gpu::Filter::Trilinear}),
      scale_(probe.environment.scale) {
    const lighting::CubeLayout& layout = probe.environment.layout;
    const std::vector<std::uint16_t> halves = to_working_space(probe.environment, glm::mat3(rec709_to_working));
    for (int level = 0; level < layout.levels; ++level) {
        const std::size_t begin = 3 * layout.offset(level);
        const std::size_t end = 3 * layout.offset(level + 1);
        map_.upload(std::span<const std::uint16_t>(halves).subspan(begin, end - begin), {.level = level, .layers = 6});
    }
}

}  // namespace rowland::render
