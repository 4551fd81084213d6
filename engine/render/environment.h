#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>

#include "engine/gpu/texture.h"
#include "engine/lighting/light_probe.h"

namespace rowland::render {

/// A light probe on the GPU, in the working space.
class Environment {
 public:
    Environment(const lighting::LightProbe& probe, const glm::dmat3& rec709_to_working);

    const gpu::Texture& map() const { return map_; }
    float radiance_scale() const { return scale_; }
    /// SH of irradiance/π.
    const std::array<glm::vec4, 9>& ambient() const { return ambient_; }

 private:
    gpu::Texture map_;
    float scale_ = 1.0F;
    std::array<glm::vec4, 9> ambient_ = {};
};

}  // namespace rowland::render
