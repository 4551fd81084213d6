#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "engine/core/byte_stream.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// One piece of an order's spectrum: its light comes from about s_g = x/d − v_g.
struct StreakNode {
    float path_nm = 0.0F;        ///< x at the piece's centre of weight
    float width_nm = 0.0F;       ///< of the even piece of x with the same variance
    float wavelength_nm = 0.0F;  ///< |x/m|; of order 0 the observer's and the light's centre
    glm::mat3 weight{0.0F};      ///< ∫ η_m cmf Eᵀ dλ over the piece: RGB in, XYZ out
};

/// A narrow lobe: the grating mirrors along the grooves and disperses across them (PHYSICS §6 "streak"). Per node, the
/// light about (s_g, s_h) = (x/d − v_g, −v_h), blurred by the lobe along the grooves and by the piece's width across.
struct Streak {
    double pitch_nm = 0.0;
    double sigma = 0.0;  ///< of the lobe, in units of s_h
    double share = 1.0;  ///< of the power that the lobe carries: κ of Stam's pits
    std::vector<StreakNode> nodes;
};

/// Every pixel goes through all nodes.
inline constexpr int kMostStreakNodes = 1024;

struct StreakSettings {
    int nodes_per_order = 8;  ///< ≥ 1; with 5 taps .4 % under Venice sunset, 3 % under Grace (a lobe of .05, measured)
    colour::Illuminant illuminant = colour::d65();
};

/// Throws Error (input) for fewer than kManyGrooves grooves, the flat lobe, and pits without a coherent share: neither
/// has a streak.
Streak make_streak(const Grating& grating, const StreakSettings& settings);

/// What the streak leaves of a grating with Stam's pits, as a smooth lobe that SH can carry: the grating with an
/// incoherent lobe, to be weighed with 1 − share. None for other lobes.
std::optional<Grating> incoherent_rest(const Grating& grating);

/// A place across the lobe, in units of σ: its middle, its width, and its share of the lobe's power. Shares sum to 1.
struct LobeTap {
    double offset = 0.0;
    double width = 0.0;
    double share = 0.0;
};
std::vector<LobeTap> lobe_taps(int count);

/// Directions nearer to the horizon are filtered as if they were so far above it: footprints grow as 1/s_n.
inline constexpr double kLowestStreakHeight = 0.02;

/// Mean radiance (linear RGB) over the parallelogram that two vectors span about a direction, as textureGrad() filters.
/// Directions in the tangent frame (g, h, n).
using FilteredRadiance =
    std::function<glm::dvec3(const glm::dvec3& direction, const glm::dvec3& along_g, const glm::dvec3& along_h)>;

/// XYZ of the streak for the tangent-frame view: every node reads `taps` places across the lobe, about s_h = −v_h.
/// What of them or of the piece is below the horizon is dark; 0 for v_n ≤ 0.
glm::dvec3 evaluate(const Streak& streak, const FilteredRadiance& radiance, const glm::dvec3& view, int taps = 5);

/// The most nodes that a view sees at once: no more are read for a pixel.
int most_seen_nodes(const Streak& streak);

void write(const Streak& streak, ByteWriter& writer);
/// Throws Error (input) if the bytes are not such a streak, or one of more than kMostStreakNodes.
Streak read_streak(ByteReader& reader);

}  // namespace rowland::diffraction
