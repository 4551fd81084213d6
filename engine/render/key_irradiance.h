#pragma once

#include <glm/mat3x3.hpp>
#include <span>

#include "engine/gpu/texture.h"
#include "engine/lighting/key_lights.h"

namespace rowland::render {

/// Irradiance from a probe's key lights over the surface's normal, so that a pixel pays one look-up for all of them. A
/// cube map of half floats, times scale().
class KeyIrradiance {
 public:
    /// In the working space. At the map's 64² texels a face it is off by at most 6e-3 of a point light's irradiance
    /// (where its cosine is cut off at the horizon), and by less for wider lobes.
    KeyIrradiance(std::span<const lighting::KeyLight> keys, const glm::dmat3& rec709_to_working);

    const gpu::Texture& map() const { return map_; }
    float scale() const { return scale_; }

 private:
    gpu::Texture map_;
    float scale_ = 1.0F;
};

}  // namespace rowland::render
