#include "modules/diffraction/runtime/radiance_cube.h"

#include <algorithm>
#include <span>
#include <vector>

#include "modules/diffraction/bake/cube_pyramid.h"
#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

RadianceCube::RadianceCube(const lighting::PackedEnvironmentMap& map) : scale_(map.scale) {
    const CubePyramid pyramid(lighting::unpack(map));
    const lighting::CubeLayout& layout = pyramid.layout();
    texture_ = gpu::Texture({.kind = gpu::TextureKind::CubeMap,
                             .format = gpu::Format::RGBA16F,
                             .width = layout.face_size,
                             .height = layout.face_size,
                             .levels = layout.levels},
                            {.filter = gpu::Filter::Trilinear});
    for (int level = 0; level < layout.levels; ++level) {
        const std::span<const glm::vec3> texels = pyramid.level(level);
        std::vector<glm::vec3> stored(texels.size());
        std::transform(texels.begin(), texels.end(), stored.begin(),
                       [&](const glm::vec3& texel) { return texel / scale_; });
        texture_.upload(std::span<const glm::vec3>(stored), {.level = level, .layers = 6});
    }
}

void RadianceCube::bind(const gpu::Program& program) const {
    texture_.bind(kRadianceUnit);
    program.set("radiance_scale", scale_);
}

}  // namespace rowland::diffraction
