#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/lighting/probe_image.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/model/shading_point.h"
#include "modules/diffraction/representations/evaluation_light.h"

namespace rowland::inspector {

/// The light that the listed orders send to the eye from one point.
struct PointRadiance {
    std::vector<double> spectrum;  ///< relative radiance per nm at 380, 381, … 780 nm
    glm::dvec3 reference{0.0};     ///< XYZ by the reference
    glm::dvec3 drawn{0.0};         ///< XYZ by the material's representation
};

/// `light` must be made from `probe`. White light has the material's illuminant. The frame must be valid.
PointRadiance point_radiance(const diffraction::CookedMaterial& cooked, const lighting::ProbeImage& probe,
                             const diffraction::EvaluationLight& light, const diffraction::ShadingPoint& frame);

/// Spectral radiance Σ_m η_m(λ) Σ_c E_c(λ) A_c(mλ/d − v_g), the integrand of PHYSICS §4, every nanometre from 380 to
/// 780. Order 0, a δ in wavelength and direction, is left out.
std::vector<double> spectrum_at(const diffraction::Material& material, const lighting::ProbeImage& probe,
                                const diffraction::ShadingPoint& frame);

/// Luminance Y over the angle of view, in the plane across the grooves.
struct ViewSweep {
    std::vector<double> angles_deg;
    std::vector<double> reference;
    std::vector<double> harmonics;  ///< by `bands` bands of SH without key lights
    std::vector<double> drawn;      ///< by the material's representation
    int bands = 0;
};

/// A sweep of `views` views from −80° to 80° over a surface with the frame's normal and grating vector. If it is asked
/// to stop, it returns early with an incomplete result.
ViewSweep view_sweep(const diffraction::CookedMaterial& cooked, const lighting::ProbeImage& probe,
                     const diffraction::EvaluationLight& light, const diffraction::ShadingPoint& surface, int bands,
                     int views = 61, const std::stop_token& stop = {});

}  // namespace rowland::inspector
