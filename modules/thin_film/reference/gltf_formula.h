#pragma once

#include <glm/vec3.hpp>

#include "modules/thin_film/model/film.h"

namespace rowland::thin_film {

/// The linear Rec.709 reflectance of a bare base at normal incidence, as a renderer of glTF has it.
glm::dvec3 normal_colour(const Base& base);

/// The approximation that KHR_materials_iridescence recommends [Belcour & Barla 2017]: the linear Rec.709 reflectance
/// of a film of constant index on a dielectric of that reflectance at normal incidence. Schlick's Fresnel terms, two
/// orders of interference, and observers that are sums of Gaussians in frequency. Only to compare with.
glm::dvec3 gltf_formula(double film_ior, double thickness_nm, const glm::dvec3& base_f0, double cosine);

}  // namespace rowland::thin_film
