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

/// One interval of an order's spectrum: its light comes from about s_g = x/d − v_g.
struct StreakNode {
    float path_nm = 0.0F;        ///< weighted mean x of the interval
    float width_nm = 0.0F;       ///< of the uniform interval of x with the same variance
    float wavelength_nm = 0.0F;  ///< |x/m|; for order 0 the weighted mean of the visible range
    glm::mat3 weight{0.0F};      ///< ∫ η_m cmf Eᵀ dλ over the interval: RGB in, XYZ out
};

/// A narrow lobe: the grating mirrors along the grooves and disperses across them (PHYSICS §6 "streak"). Each node sees
/// the light about (s_g, s_h) = (x/d − v_g, −v_h), blurred by the lobe along the grooves and by the node's width
/// across.
struct Streak {
    double pitch_nm = 0.0;
    double sigma = 0.0;  ///< of the lobe, in units of s_h
    double power = 1.0;  ///< fraction of the power in the narrow lobe: κ of Stam's pits
    std::vector<StreakNode> nodes;
};

/// Every pixel loops over all nodes.
inline constexpr int kMostStreakNodes = 1024;

struct StreakSettings {
    /// ≥ 1. Measured errors of 8 with 5 taps, for a lobe of .05: .4 % under Venice sunset, 3 % under Grace.
    int nodes_per_order = 8;
    colour::Illuminant illuminant = colour::d65();
};

/// Throws Error (input) for fewer than kManyGrooves grooves, and for lobes without a streak: the flat lobe, and pits
/// without a coherent fraction.
Streak make_streak(const Grating& grating, const StreakSettings& settings);

/// The incoherent rest of a grating with Stam's pits: the same grating with the incoherent, smooth lobe, which SH can
/// represent. Its weight is 1 − Streak::power. nullopt for other lobes.
std::optional<Grating> incoherent_rest(const Grating& grating);

/// A sample interval across the lobe, in units of σ.
struct LobeTap {
    double offset = 0.0;  ///< of the middle
    double width = 0.0;
    double weight = 0.0;  ///< fraction of the lobe's power; the weights sum to 1
};
std::vector<LobeTap> lobe_taps(int count);

/// Least s_n for the footprint of a direction, which grows as 1/s_n.
inline constexpr double kLowestStreakHeight = 0.02;

/// Mean radiance (linear RGB) over the parallelogram that two vectors span about a direction, as textureGrad() filters.
/// Directions in the tangent frame (g, h, n).
using FilteredRadiance =
    std::function<glm::dvec3(const glm::dvec3& direction, const glm::dvec3& along_g, const glm::dvec3& along_h)>;

/// XYZ of the streak for the tangent-frame view: every node reads `taps` samples across the lobe, about s_h = −v_h.
/// Light below the horizon is black. 0 for v_n ≤ 0. A cover multiplies each sample by T(s_n); T(v_n) is left out.
glm::dvec3 evaluate(const Streak& streak, const FilteredRadiance& radiance, const glm::dvec3& view, int taps = 5,
                    const std::optional<Cover>& cover = std::nullopt);

/// The most nodes that one view sees, and so that one pixel reads.
int most_seen_nodes(const Streak& streak);

void write(const Streak& streak, ByteWriter& writer);
/// Throws Error (input) for invalid bytes, or more than kMostStreakNodes nodes.
Streak read_streak(ByteReader& reader);

}  // namespace rowland::diffraction
