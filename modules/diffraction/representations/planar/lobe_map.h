#pragma once

#include <algorithm>
#include <functional>
#include <glm/vec3.hpp>
#include <stop_token>
#include <vector>

#include "engine/lighting/light_samples.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/planar/lobe_spectrum.h"
#include "modules/diffraction/representations/planar/planar_map.h"

namespace rowland::diffraction {

struct LobeMapSize {
    int azimuths = 352;  ///< of a whole turn: a multiple of 4, ≥ 8; 1: that of one g alone
    LobeMapViews views;
};

/// The size of the map that is shown while a larger one is filled: it is filled within 40 ms on two cores.
inline constexpr LobeMapSize kCoarseLobeMap{.azimuths = 64, .views = {.g = 64, .h = 32}};
/// The same for an object whose g is the same everywhere.
inline constexpr LobeMapSize kCoarseLobeSlice{.azimuths = 1, .views = {.g = 128, .h = 128}};

/// The size of the map that replaces one of `size` for an object whose g is the same everywhere: twice as many views
/// along each axis, 384 at most. More would show the probe's texels. The map of 256 × 256 has 511 × 511 texels
/// (fill_lobe_slice()), 1 MB, and its LobeSpectrum 25 MB.
constexpr LobeMapSize one_azimuth(const LobeMapSize& size) {
    constexpr int kMost = 384;
    return {.azimuths = 1, .views = {.g = std::min(2 * size.views.g, kMost), .h = std::min(2 * size.views.h, kMost)}};
}

/// Slices of a map. An even pattern needs only a half turn, both ends included.
constexpr int slices(const LobeMapSize& size, bool half_turn) {
    return half_turn ? size.azimuths / 2 + 1 : size.azimuths;
}

/// The radiance of a flat grating of any lobe under a probe (PHYSICS §6 "planar"): over the azimuth of g in the plane,
/// v_g and v_h. A volume texture, GL_LINEAR:
///   v_g: texel j holds v_g = 2j/(views.g − 1) − 1, both ends included;   s = (½(v_g+1)(views.g−1) + ½)/views.g
///   v_h: the same in t
///   azimuth φ: g = cos φ e1 + sin φ e2, slice i holds φ = 2π i/azimuths. A pattern with P(−u) = P(u) needs the half
///     turn alone, as (φ + π, −v_g, −v_h) is then equal to (φ, v_g, v_h): azimuths/2 + 1 slices, GL_CLAMP_TO_EDGE in r.
///     Others have `azimuths` slices, GL_REPEAT in r. A map of one azimuth is one slice, whose g is e2: at φ = π/2 no
///     rounding reaches the other half turn.
///   values are optimised for linear interpolation (kBestLinear), not the radiance at the nodes
struct LobeMap {
    LobeMapSize size;
    bool half_turn = false;
    PlaneAxes axes;
    std::vector<glm::vec3> values;  ///< XYZ, or what in_space() made of it: [(slice · views.h + j_h) · views.g + j_g]
};

/// The map in another colour space. Maps are filled in XYZ, where no light has a negative component.
LobeMap in_space(LobeMap map, const glm::dmat3& xyz_to_space);

/// Fills a map: correlates the light seen from straight above, turned to each azimuth, with the pattern, PHYSICS (6.2),
/// by Fourier transforms. Uses all cores; the result does not depend on their number. After a stop request it returns
/// early with an unusable map.
LobeMap fill_lobe_map(const lighting::LightSamples& texels, const LobeSpectrum& spectrum, const glm::dvec3& normal,
                      int azimuths, const std::stop_token& stop = {});

/// sample(fill_lobe_map(...), point) for few points: fills the slices that a point sees. For one thread. `spectrum`
/// must outlive the result.
std::function<glm::dvec3(const ShadingPoint&)> lobe_map_of_points(const lighting::LightSamples& texels,
                                                                  const LobeSpectrum& spectrum,
                                                                  const glm::dvec3& normal, int azimuths);

/// Fills a map of one azimuth, that of `grating`. Uses one core. The map has two texels for each step of the spectrum's
/// views along both axes, and they are a quadratic spline's.
LobeMap fill_lobe_slice(const lighting::LightSamples& texels, const LobeSpectrum& spectrum, const glm::dvec3& normal,
                        const glm::dvec3& grating);

/// The value of a point whose normal is the map's, as the texture unit interpolates; black for a view below the
/// horizon.
glm::dvec3 sample(const LobeMap& map, const ShadingPoint& frame);

}  // namespace rowland::diffraction
