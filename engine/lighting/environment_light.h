#pragma once

#include <glm/vec3.hpp>

#include "engine/lighting/environment_map.h"

namespace rowland::lighting {

// What surfaces see of a prefiltered environment, as engine/render/shaders/forward_fragment_main.glsl computes it.

/// Linear Rec.709 radiance along `direction`, of any length, under the lobe of a perceptual roughness: linear between
/// texels, over the edges of faces, and between levels.
glm::dvec3 environment_light(const EnvironmentMap& map, const glm::dvec3& direction, double roughness);

/// Where the light of a surface's lobe is looked up if it is looked up once. n and v are unit; the result is not.
glm::dvec3 lobe_direction(const glm::dvec3& n, const glm::dvec3& v, double roughness);

}  // namespace rowland::lighting
