#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/colour/spectrum.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/point_shader.h"
#include "modules/thin_film/model/film.h"

namespace rowland::inspector {

/// One order of one wavelength in the plane across the grooves. In this file the shown orders of a grating are the
/// listed ones and the mirror's order 0.
struct OrderPeak {
    int order = 0;
    double angle_deg = 0.0;  ///< of the diffracted light; positive toward +g
    double efficiency = 0.0;
    double brdf = 0.0;  ///< at the peak, 1/sr; 0 if the order is not listed
};

/// The diffraction term over the angle of view, for light of one wavelength.
struct AngleCurve {
    std::vector<glm::dvec2> points;  ///< (angle in degrees, BRDF in 1/sr), ascending
    std::vector<OrderPeak> peaks;    ///< the shown orders that leave the surface, ascending angles
};

/// brdf_energy() (PHYSICS §3) over views in the plane across the grooves, for light from `incidence_deg` (through a
/// sheet: from behind). Both angles are within ±90°. Has `samples` evenly spaced angles, and more around each peak.
AngleCurve angle_curve(const diffraction::Grating& grating, double wavelength_nm, double incidence_deg,
                       int samples = 721);

/// The efficiency of one order over wavelength.
struct EfficiencyCurve {
    int order = 0;
    std::vector<glm::dvec2> points;  ///< (wavelength in nm, efficiency), 380 to 780 nm
};

/// Efficiencies of the shown orders every 4 nm, sorted by order; at most `most` curves: of order 0 and of the strongest
/// others. s_g, the light's component across the grooves, has no effect in scalar theory. Under a cover: of the light
/// that enters it.
std::vector<EfficiencyCurve> efficiency_curves(const diffraction::Grating& grating, double s_g = 0.0,
                                               std::size_t most = 9);

/// Fractions of the power of one wavelength; they sum to 1. Under a cover: of the light that enters it.
struct EnergyBalance {
    double orders = 0.0;      ///< listed orders that leave the surface
    double zero = 0.0;        ///< the mirror's order
    double evanescent = 0.0;  ///< listed orders that do not leave the surface: lost to the scalar model
    double absorbed = 0.0;    ///< by the metal and a cover's dye; of a table 1 minus the sum of its orders
    double residual = 0.0;    ///< orders that are not listed, and losses of the profile; it lights the base
};

/// For light of a wavelength from s_g, |s_g| ≤ 1, energy-normalised whatever the material's normalisation is.
EnergyBalance energy_balance(diffraction::Grating grating, double wavelength_nm, double s_g);

/// The direction of one wavelength of an order: components of the unit vector across and along the grooves.
struct OrderSpot {
    double wavelength_nm = 0.0;
    double v_g = 0.0;
    double v_h = 0.0;
};

struct OrderTrace {
    int order = 0;
    std::vector<OrderSpot> spots;  ///< that leave the surface, ascending wavelengths
};

/// Directions of the shown orders for light from the direction `s` of the tangent frame (g, h, n), s_n > 0:
/// d (s_g + v_g) = mλ, s_h + v_h = 0 (PHYSICS §2), every 5 nm from 380 to 780 nm. Orders without spots are left out.
std::vector<OrderTrace> order_directions(const diffraction::Grating& grating, const glm::dvec3& s);

/// The colour of white light over the path difference x = d u (PHYSICS §4).
struct KernelStrip {
    double begin_nm = 0.0;
    double end_nm = 0.0;
    std::vector<glm::dvec3> xyz;  ///< mean over each of the equal cells, for white light R = G = B = 1; per nm
};

/// Over all path differences that directions can have, |x| ≤ 2d, where the kernel is not 0. No cells if it is 0
/// everywhere.
KernelStrip kernel_strip(const diffraction::KernelTable& kernel, double pitch_nm, int cells = 512);

/// The diffraction pattern of white light of the material's illuminant, as a square picture over u = s + v in the
/// surface (g, h). Mirrored light has u = 0.
struct PatternFigure {
    double half_width = 0.0;      ///< largest |u_g|, |u_h|; beyond are only the faintest orders
    int size = 0;                 ///< texels of a side
    std::vector<glm::dvec3> xyz;  ///< row by row from the smallest u_h; Y has a mean of 1, weighted by itself

    const glm::dvec3& at(double u_g, double u_h) const;
};

/// The pattern of a grating with a lattice. Empty if no order has light.
PatternFigure pattern_figure(const diffraction::Material& material);

/// Radiance of the listed orders from one point to the eye.
struct PointRadiance {
    std::vector<double> spectrum;  ///< relative radiance per nm at 380, 381, … 780 nm
    glm::dvec3 reference{0.0};     ///< XYZ by the reference
    glm::dvec3 drawn{0.0};         ///< XYZ by the material's representation
};

/// `light` must be `probe`, divided into key lights and the residual. White light has the material's illuminant. The
/// frame must be valid. `layout`: of the object that the point is on.
PointRadiance point_radiance(const diffraction::CookedMaterial& cooked, const lighting::ProbeImage& probe,
                             const diffraction::EvaluationLight& light, const diffraction::ShadingPoint& frame,
                             diffraction::GrooveLayout layout);

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

/// A sweep of `views` views from −80° to 80° over a surface with the frame's normal and grating vector. If it is
/// stopped, it returns early with an incomplete result.
ViewSweep view_sweep(const diffraction::CookedMaterial& cooked, const lighting::ProbeImage& probe,
                     const diffraction::EvaluationLight& light, const diffraction::ShadingPoint& surface,
                     diffraction::GrooveLayout layout, int bands, int views = 61, const std::stop_token& stop = {});

/// A film and the angle of view.
struct FilmInputs {
    thin_film::Film film{.layers = {{.index = 1.33, .thickness_nm = 400.0}}, .base = std::complex<double>(1.0, 0.0)};
    double roughness = 0.0;          ///< perceptual
    double angle_deg = 0.0;          ///< of the view
    std::string illuminant = "D65";  ///< a built-in one

    friend bool operator==(const FilmInputs&, const FilmInputs&) = default;
};

/// XYZ of reflected white light: by the exact sum, averaged over the lobe of a rough surface; by a table as it is baked
/// for drawing; by the formula that glTF recommends for films of one layer, empty for others.
struct FilmColours {
    std::vector<glm::dvec3> exact;
    std::vector<glm::dvec3> table;
    std::vector<glm::dvec3> formula;
};

struct FilmCurves {
    std::vector<glm::dvec2> spectrum;  ///< nm, fraction reflected by the smooth film at the angle
    std::vector<glm::dvec2> bare;      ///< likewise without the film
    std::vector<double> angles_deg;
    FilmColours over_angle;
    /// Of the outermost layer: 0 to 800, or the last 800 up to its own thickness if that is larger.
    std::vector<double> thicknesses_nm;
    FilmColours over_thickness;  ///< at the angle
    bool complete = false;       ///< the table is baked; its colours are empty before
    double table_error = 0.0;    ///< over_thickness against the exact sum, relative RMS
    double formula_error = 0.0;
};

/// Takes a second or two. The film must have a layer. Publishes the curves without the table first. nullopt if it was
/// stopped.
std::optional<FilmCurves> film_curves(const FilmInputs& inputs, const std::stop_token& stop,
                                      const std::function<void(FilmCurves)>& publish);

}  // namespace rowland::inspector
