#pragma once

#include <glm/mat3x3.hpp>
#include <span>

#include "engine/gpu/texture.h"
#include "engine/lighting/key_lights.h"

namespace rowland::render {

/// Irradiance from a probe's key lights over the surface's normal, so that all of them cost one look-up per pixel. A
/// cube map of half floats, times scale().
class KeyIrradiance {
 public:
    /// In the working space. With 64² texels per face the error is at most 6e-3 of a point light's irradiance (where
    /// its cosine is clamped at the horizon), and less for wider lobes.
    KeyIrradiance(std::span<const lighting::KeyLight> keys, const glm::dmat3& rec709_to_working);

    const gpu::Texture& map() const { return map_; }
    float scale() const { return scale_; }

 private:
    gpu::Texture map_;
    float scale_ = 1.0F;
};

}  // namespace rowland::render
