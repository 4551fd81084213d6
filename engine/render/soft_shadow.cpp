#include "engine/render/soft_shadow.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

namespace rowland::render {

float penumbra_over_depth(const ShadowView& view, int size, float angular_radius) {
    const float depth_m = 2.0F / glm::length(glm::vec3(glm::row(view.world_to_clip, 2)));
    return std::tan(angular_radius) * depth_m / (view.texel_m * static_cast<float>(size));
}

}  // namespace rowland::render
