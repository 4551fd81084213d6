#pragma once

#include <glm/vec3.hpp>

#include "engine/colour/illuminant.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// Weights of the engine's own shading of a grating: XYZ of the illuminant's white (Y = 1) after the grating.
struct LayerWeights {
    glm::dvec3 mirror{0.0};  ///< the zero order, unless `orders` lists 0 (then the diffraction term shades it); a
                             ///< sheet that transmits sends it straight on
    glm::dvec3 base{1.0};  ///< 1 − Σ listed η − η₀, of both sides of a sheet, at least 0: the light that reaches
                           ///< the base layer. 0 for a sheet's reflected side alone
};

/// PHYSICS §2, "Zero order". Each weight is ∫ w(λ) cmf(λ) S(λ) dλ, S the illuminant, of luminance 1.
LayerWeights layer_weights(const Grating& grating, const colour::Illuminant& illuminant = colour::d65());

}  // namespace rowland::diffraction
