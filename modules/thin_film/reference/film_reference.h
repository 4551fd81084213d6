#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/lighting/light_samples.h"
#include "modules/thin_film/model/film.h"

namespace rowland::thin_film {

/// The linear Rec.709 reflectance of a bare base at normal incidence, as a renderer of glTF has it.
glm::dvec3 normal_colour(const Base& base);

/// The approximation that KHR_materials_iridescence recommends [Belcour & Barla 2017]: the linear Rec.709 reflectance
/// of a film of constant index on a dielectric of reflectance `base_f0` at normal incidence. Schlick's Fresnel terms,
/// two orders of interference, and observers that are sums of Gaussians in frequency. Only to compare with.
glm::dvec3 gltf_formula(double film_ior, double thickness_nm, const glm::dvec3& base_f0, double cosine);

/// Ground truth for rough films: every microfacet with its own light, and the exact sum over wavelengths at its angle.
class RoughReference {
 public:
    RoughReference(const Film& film, const colour::LightSpectra& spectra);

    struct Reflected {
        glm::dvec3 xyz{0.0};              ///< radiance toward v
        glm::dvec3 without_fresnel{0.0};  ///< linear Rec.709 if the microfacets reflected everything
    };
    /// GGX with height-correlated Smith visibility, single reflections. n and v are unit, world axes; `roughness` is
    /// perceptual, > 0, and its lobe wider than the light's samples.
    Reflected reflected(const lighting::LightSamples& light, const glm::dvec3& n, const glm::dvec3& v,
                        double roughness) const;

    /// M, PHYSICS (4.1), from a table of 1001 cosines.
    glm::dmat3 at(double cosine) const;

 private:
    std::vector<glm::dmat3> values_;
};

}  // namespace rowland::thin_film
