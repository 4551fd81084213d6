#pragma once

#include <complex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/model/profile.h"

namespace rowland::diffraction {

/// The profiles that the rigorous solver takes. All have a depth; another one also needs its modes (modes.h).
using ReliefShape = std::variant<LamellarProfile, SinusoidalProfile, BlazedProfile>;
/// nullopt for another profile.
std::optional<ReliefShape> relief_shape(const Profile& profile);

/// A relief that the rigorous solver takes: periodic along g, uniform along h, on a substrate whose index is given with
/// the wavelength. A depth of 0 is a flat surface.
///
/// Films follow the relief. On a sinusoidal one each surface of a film is the relief's moved up by the thickness. On a
/// blazed one films are equally thick on both facets, measured at right angles to them. On a lamellar one they lie on
/// bars and groove floors, but not on the vertical walls.
struct Relief {
    double pitch_nm = 0.0;
    ReliefShape shape = {};
    std::vector<DielectricFilm> films = {};  ///< from the substrate up
    double ambient_ior = 1.0;                ///< of the medium that the light comes from, ≥ 1
    bool mirrored = false;                   ///< along g: a blazed surface descends toward +g, or ascends if mirrored

    friend bool operator==(const Relief&, const Relief&) = default;
};

/// Checks what solve() requires. Throws Error (input) that calls the relief `name` for a pitch not in (0, 1e5) nm, a
/// depth not in [0, 4 pitches], a duty not in (0, 1), an ambient index outside 1 to 4, more than kMaximumFilms films,
/// or a film that is thicker than the pitch or has an index outside 1 to 4.
void check_relief(const Relief& relief, const std::string& name);

/// The coarsest grating that is solved: 105 orders of visible light are above the horizon.
inline constexpr double kCoarsestSolved_nm = 20000.0;

/// What lies under a relief: a metal, or a transparent sheet of this index, whose other face is flat.
using Substrate = std::variant<colour::Metal, double>;
/// n + ik.
std::complex<double> index_of(const Substrate& substrate, double wavelength_nm);

/// Why rigorous theory cannot solve a grating; nullopt if it can. It takes at least kManyGrooves lamellar, sinusoidal
/// or blazed grooves of a metal, in air or under a cover, or of a sheet that transmits. The pitch is above 190 nm, up
/// to which no visible order but 0 propagates, and at most kCoarsestSolved_nm; the depth is at most four pitches. Films
/// are not checked.
std::optional<Refusal> rigorous_refusal(const Grating& grating);

/// The relief of a grating with its films; a sheet's is mirrored, as it is thickest toward +g (PHYSICS §12). Throws
/// Error (input) that calls it `name` where rigorous_refusal() or check_relief() refuses it.
Relief relief_of(const Grating& grating, const std::string& name);
/// The substrate of a grating that relief_of() takes.
Substrate substrate_of(const Grating& grating);

}  // namespace rowland::diffraction
