#pragma once

#include <glm/mat3x3.hpp>

#include "engine/gpu/texture.h"
#include "engine/lighting/light_probe.h"

namespace rowland::render {

/// A light probe's prefiltered environment on the GPU, in the working space.
class Environment {
 public:
    Environment(const lighting::LightProbe& probe, const glm::dmat3& rec709_to_working);

    const gpu::Texture& map() const { return map_; }
    float radiance_scale() const { return scale_; }

 private:
    gpu::Texture map_;
    float scale_ = 1.0F;
};

}  // namespace rowland::render
