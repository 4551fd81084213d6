#pragma once

#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <type_traits>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/core/byte_stream.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/arc/arc_table.h"
#include "modules/diffraction/representations/streak/streak_map.h"

namespace rowland::diffraction {

/// Nodes of a segment.
inline constexpr int kSegmentNodes = 7;
/// Every pixel loops over all segments.
inline constexpr std::size_t kMostStreakSegments = 64;

/// Equidistant nodes over an interval of path differences: node j sees the light about s_g = x_j/d − v_g. Stored as it
/// is in memory.
struct StreakSegment {
    float first_nm = 0.0F;
    float step_nm = 0.0F;
    std::array<glm::mat3, kSegmentNodes> weights{};  ///< RGB in, XYZ out, per radiance that a node sees

    float path_nm(int node) const { return first_nm + static_cast<float>(node) * step_nm; }
};
static_assert(sizeof(StreakSegment) == sizeof(float) * (2 + 9 * std::size_t{kSegmentNodes}) &&
              std::is_trivially_copyable_v<StreakSegment>);

/// A narrow lobe: the grating mirrors along the grooves and disperses across them (PHYSICS §6 "streak"). The nodes
/// replace the colour kernel of all orders: Σ_j weight_j N(u − u_j; width) is the closest to d k(d u).
struct Streak {
    double pitch_nm = 0.0;
    double sigma = 0.0;  ///< of the lobe, in units of s_h
    double power = 1.0;  ///< fraction of the power in the narrow lobe: κ of Stam's pits
    std::vector<StreakSegment> segments;

    /// Half the interval of r = √(1 − s_g²) in which the horizon cuts the lobe. The fraction of the lobe above the
    /// horizon is taken as linear in r² there.
    double reach() const { return 1.7320508 * sigma; }
};

struct StreakSettings {
    int map_resolution = 320;  ///< sets the width of the nodes too
    colour::Illuminant illuminant = colour::d65();
};

/// Throws Error (input) for fewer than kManyGrooves grooves, and for lobes without a streak: the flat lobe, and pits
/// without a coherent fraction.
Streak make_streak(const Grating& grating, const StreakSettings& settings);

/// The map that the streak's nodes look up. Its side is `map_resolution` rounded down to a multiple of 4.
StreakMapSize map_size(const Streak& streak, int map_resolution);

/// The incoherent part of a grating with Stam's pits: the same grating with the incoherent, smooth lobe, which SH can
/// represent. Its weight is 1 − Streak::power. nullopt for other lobes.
std::optional<Grating> incoherent_part(const Grating& grating);

/// XYZ of the streak for the tangent-frame view; the columns of `axes` are g, h, n in the world. Every segment looks up
/// the map at its nodes, whose positions lie on a parabola through three points of the segment (StreakPath). Light
/// below the horizon is black. 0 for v_n ≤ 0. A cover multiplies each node by T(s_n); T(v_n) is left out.
glm::dvec3 evaluate(const Streak& streak, const StreakMap& map, const glm::dmat3& axes, const glm::dvec3& view,
                    const std::optional<Cover>& cover = std::nullopt);

/// The most nodes that one view sees, and thus that one pixel reads.
int most_seen_nodes(const Streak& streak);

void write(const Streak& streak, ByteWriter& writer);
/// Throws Error (input) for invalid bytes, or more than kMostStreakSegments segments.
Streak read_streak(ByteReader& reader);

/// Shades a narrow lobe from a map of the whole probe, and the incoherent part of Stam's pits with an arc table.
struct StreakSurfaceSettings {
    StreakSettings streak;
    std::optional<ArcSettings> incoherent{};  ///< of incoherent_part(), if any

    static const RepresentationInfo& info();
    static StreakSurfaceSettings from(const SettingValues& values, const Grating& grating);
    void set_illuminant(const colour::Illuminant& white);
};

struct StreakTables {
    Streak streak{};
    StreakMapSize map;
    std::optional<ArcTable> incoherent{};  ///< of weight 1 − streak.power
};

StreakTables bake(const Grating& grating, const StreakSurfaceSettings& settings);
void write(const StreakTables& tables, ByteWriter& writer);
StreakTables read(ByteReader& reader, const StreakSurfaceSettings& settings);
ShadingCost cost(const StreakTables& tables);
Facts facts(const StreakTables& tables);
/// `tables` must outlive the result. Throws Error (input) for band-limited light.
PointShader point_shader(const StreakTables& tables, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction
