#include "engine/scene/punctual_light.h"

#include <algorithm>
#include <cmath>

namespace rowland::scene {

float attenuation(const PunctualLight& light, float distance_m, float cos_axis) {
    float share = 1.0F;
    if (light.range_m > 0.0F) {
        const float ratio = distance_m / light.range_m;
        share = std::max(0.0F, 1.0F - ratio * ratio * ratio * ratio);
    }
    if (!light.spot) return share;
    // The difference is kept from 0 as the extension's reference code does.
    const float cos_inner = std::cos(light.inner_cone);
    const float cos_outer = std::cos(light.outer_cone);
    const float cone = std::clamp((cos_axis - cos_outer) / std::max(0.001F, cos_inner - cos_outer), 0.0F, 1.0F);
    return share * cone * cone;
}

}  // namespace rowland::scene
