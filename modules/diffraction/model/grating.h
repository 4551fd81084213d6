#pragma once

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/colour/spectrum.h"
#include "modules/diffraction/model/efficiency_grid.h"
#include "modules/diffraction/model/lattice.h"
#include "modules/diffraction/model/lobe.h"
#include "modules/diffraction/model/profile.h"

namespace rowland::diffraction {

/// A transparent layer over the grooves: a disc's polycarbonate, a foil's lacquer (PHYSICS §10).
struct Cover {
    double ior = 1.58;  ///< n at all wavelengths, at least 1
    /// Linear Rec.709 in [0, 1]: what a dye in the layer passes on the way in, and on the way out.
    glm::dvec3 tint{1.0};
};

/// T(c), PHYSICS (10.1), Fresnel's formulas: the fraction of unpolarised light that passes between air and a medium of
/// index `ior`, in either direction. `cosine`, at most 1, is that of the angle in air; T is 0 for cosines up to 0.
double transmittance(double ior, double cosine);

/// The same of a cover; 1 without one.
inline double transmittance(const std::optional<Cover>& cover, double cosine) {
    return cover ? transmittance(cover->ior, cosine) : 1.0;
}

/// τ², PHYSICS (10.4): what the tint passes on the way in and out at normal incidence; 1 without a cover.
double dye_transmittance(const std::optional<Cover>& cover, double wavelength_nm);

/// The index of the medium that the grooves lie in.
inline double groove_medium(const std::optional<Cover>& cover) {
    return cover ? cover->ior : 1.0;
}

/// A shaded point in world axes: the direction to the eye, the surface normal, and the grating vector (across the
/// grooves).
struct ShadingPoint {
    glm::dvec3 view{0.0, 0.0, 1.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};
    glm::dvec3 grating{1.0, 0.0, 0.0};

    friend bool operator==(const ShadingPoint&, const ShadingPoint&) = default;
};

/// True if all three vectors are finite and not 0, and the grating vector is not along the normal.
bool is_valid(const ShadingPoint& frame);

/// The rotation from world to tangent frame: rows g, h = n × g, n, g made orthogonal to n (PHYSICS §1). The frame must
/// be valid.
glm::dmat3 world_to_tangent(const ShadingPoint& frame);

/// A transparent film on the relief of the grooves, no thicker than the pitch. Only rigorous theory includes it
/// (PHYSICS §14).
struct DielectricFilm {
    double ior = 1.5;  ///< n at all wavelengths, 1 to 4
    double thickness_nm = 0.0;

    friend bool operator==(const DielectricFilm&, const DielectricFilm&) = default;
};

inline constexpr std::size_t kMaximumFilms = 4;

/// A thin sheet that sends light through (PHYSICS §12).
struct Transmission {
    double ior = 1.5;          ///< n of the sheet at all wavelengths, at least 1; slits and tables do not depend on it
    double reflectance = 0.0;  ///< fraction of the light that the sheet reflects, in [0, 1]; it transmits the rest
};

/// How g lies on an object, which decides what `planar` draws there.
enum class GrooveLayout {
    Curved,      ///< the stand-in of the map
    Flat,        ///< a map of all azimuths
    FlatUniform  ///< g is the same everywhere: of a lobe that is not flat, or a lattice, a map of one azimuth
};

/// The point at which a reflection grating shows what a sheet that transmits shows at `frame`: the view is mirrored in
/// the surface, and the normal is reversed (PHYSICS (12.3)). The frame must be valid.
ShadingPoint lit_from_behind(const ShadingPoint& frame);

enum class Normalization {
    Energy,  ///< each order carries its efficiency: reciprocal, conserves energy
    Agu,     ///< the paper's peak form (slit only): each order times λ/550 nm, equal to Energy at 550 nm
};

/// From this many lit grooves on, an order is a delta function (N → ∞, PHYSICS §3).
inline constexpr double kManyGrooves = 50.0;

/// Wavelength at which the two normalisations agree.
inline constexpr double kAguWavelength_nm = 550.0;

/// Why a grating is refused, as the parts of an Error. `key`: the member of "quality" or, with a leading '/', of the
/// material.
struct Refusal {
    std::string key;
    std::string found;
    std::string expected;
    std::string remedy{};
};

/// How the efficiencies of a relief are found.
enum class Theory {
    Scalar,   ///< the closed forms of PHYSICS §3, which do not depend on the directions
    Rigorous  ///< Maxwell's equations, PHYSICS §14
};

/// A grating: everything that the diffraction term depends on.
struct Grating {
    double pitch_nm = 0.0;    ///< groove distance d > 0
    double grooves = 1500.0;  ///< lit grooves N ≥ 1
    Profile profile = SlitProfile{};
    std::vector<int> orders = {-2, -1, 1, 2};  ///< that are shaded: ascending, no duplicates
    Normalization normalization = Normalization::Energy;
    GrooveLobe lobe = FlatLobe{};
    std::optional<colour::Metal> metal = std::nullopt;  ///< none: R = 1. A table includes its metal
    std::optional<Cover> cover = std::nullopt;          ///< none: the grooves lie in air
    /// Instead of grooves: `orders` is then empty, and pitch_nm the shorter side of a cell.
    std::optional<Lattice> lattice = std::nullopt;
    /// None: the orders are reflected. A sheet that transmits them has no metal and no cover.
    std::optional<Transmission> transmission = std::nullopt;
    std::optional<double> side_reflectance = std::nullopt;  ///< of reflected_side(): R at all wavelengths
    Theory theory = Theory::Scalar;
    std::vector<DielectricFilm> films = {};  ///< from the metal up; of Theory::Rigorous alone
    /// Efficiencies that depend on the direction, the metal included: those of Theory::Rigorous, once they are solved,
    /// or of a table of several incidences. Null: they do not depend on it.
    std::shared_ptr<const EfficiencyGrid> efficiencies = nullptr;
};

/// The grating that reflects as a sheet does: the same orders, by scalar theory. nullopt if the grating is no sheet or
/// reflects nothing.
inline std::optional<Grating> reflected_side(const Grating& sheet) {
    if (!sheet.transmission || sheet.transmission->reflectance == 0.0) return std::nullopt;
    Grating side = sheet;
    side.transmission.reset();
    side.theory = Theory::Scalar;
    side.efficiencies = nullptr;
    side.films.clear();
    side.side_reflectance = sheet.transmission->reflectance;
    return side;
}

/// Whether radiance depends on the view's v_g alone: grooves of the flat lobe.
inline bool sees_v_g_alone(const Grating& grating) {
    return !grating.lattice && is_flat(grating.lobe);
}

/// Whether the grating shades the order.
inline bool lists(const Grating& grating, int order) {
    return std::binary_search(grating.orders.begin(), grating.orders.end(), order);
}

/// R(λ): the metal's reflectance in the medium over it, times dye_transmittance(). 1 for a table of efficiencies, which
/// includes both. Of a sheet, the fraction that it transmits; of its reflected side, the fraction that it reflects.
double reflectance(const Grating& grating, double wavelength_nm);

/// The weight of order m at wavelength λ in the diffraction term: R(λ) η_m(λ), for the "agu" normalisation times
/// λ/550 nm (PHYSICS §3). Under a cover η_m and R are those in its medium, and its dye is included; T is not
/// (PHYSICS §10). Where depends_on_direction(), `direction` is that of the light, s_g, or, which is the same by
/// reciprocity, that of the view, v_g = mλ/d − s_g.
double order_efficiency(const Grating& grating, int order, double wavelength_nm, double direction = 0.0);

/// Whether order_efficiency() depends on the direction.
inline bool depends_on_direction(const Grating& grating) {
    return grating.theory == Theory::Rigorous || grating.efficiencies != nullptr;
}

/// Whether the efficiencies are known: those of rigorous theory must be solved first (with_efficiencies() in
/// asset/material.h).
inline bool is_solved(const Grating& grating) {
    return grating.theory == Theory::Scalar || grating.efficiencies != nullptr;
}

/// order_efficiency() at the fractional order d u/λ, from the groove's own spectrum: for fewer than kManyGrooves
/// grooves. A contract violation for tables.
double fractional_order_efficiency(const Grating& grating, double fractional_order, double wavelength_nm);

/// R(λ) η_mk(λ) of a grating with a lattice, in the layout of lattice_efficiencies().
std::vector<double> lattice_order_efficiencies(const Grating& grating, double wavelength_nm);

/// R(λ) η_0(λ): the fraction of the power in the mirror reflection or, of a sheet, straight through, whatever the
/// normalisation; at normal incidence.
double zero_order_efficiency(const Grating& grating, double wavelength_nm);

/// cmf(λ) E(λ)ᵀ per nm, linear RGB in, XYZ out: what a sum over wavelengths multiplies the efficiency with.
glm::dmat3 observed_spectra(const colour::LightSpectra& spectra, double wavelength_nm);

}  // namespace rowland::diffraction
