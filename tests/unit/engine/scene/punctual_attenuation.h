#pragma once

#include <algorithm>
#include <cmath>

#include "engine/scene/light.h"

namespace rowland::scene {

/// CPU reference of the shader: the factor on `intensity`/distance²: glTF's range window max(0, 1 − (distance/range)⁴)
/// times a spot's cone (KHR_lights_punctual). `cos_axis`: cosine between the axis and the direction to the point.
inline float attenuation(const PunctualLight& light, float distance_m, float cos_axis) {
    float factor = 1.0F;
    if (light.range_m > 0.0F) {
        const float ratio = distance_m / light.range_m;
        factor = std::max(0.0F, 1.0F - ratio * ratio * ratio * ratio);
    }
    if (!light.spot) return factor;
    // The lower bound is that of the extension's reference code.
    const float cos_inner = std::cos(light.inner_cone);
    const float cos_outer = std::cos(light.outer_cone);
    const float cone = std::clamp((cos_axis - cos_outer) / std::max(0.001F, cos_inner - cos_outer), 0.0F, 1.0F);
    return factor * cone * cone;
}

}  // namespace rowland::scene
