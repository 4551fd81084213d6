#pragma once

#include <glm/vec3.hpp>

#include "engine/lighting/environment_map.h"
#include "modules/thin_film/bake/film_table.h"

namespace rowland::thin_film {

/// How a frame looks up the environment's light for a rough surface.
enum class Reflections {
    OneLookUp,   ///< the split sum
    FourLookUps  ///< Effects::rough_reflections, PHYSICS (5.4)
};

/// XYZ radiance toward v of a film of this thickness and perceptual roughness, as the shader computes it. n and v are
/// unit, world axes, n·v > 0. `roughness`: 0, or in the table's range.
glm::dvec3 drawn_radiance(const FilmTable& table, double thickness_nm, double roughness,
                          const lighting::EnvironmentMap& environment, const glm::dvec3& n, const glm::dvec3& v,
                          Reflections reflections);

}  // namespace rowland::thin_film
