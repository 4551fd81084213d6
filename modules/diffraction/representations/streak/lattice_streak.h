#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <type_traits>
#include <vector>

#include "engine/core/byte_stream.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/streak/streak.h"

namespace rowland::diffraction {

/// Nodes of a lattice's pattern on a ray, at u = path/pitch · direction. Stored as it is in memory.
struct RaySegment {
    glm::vec2 direction{1.0F, 0.0F};  ///< unit, (g, h)
    StreakSegment nodes;
};
static_assert(sizeof(RaySegment) == sizeof(StreakSegment) + 8 && std::is_trivially_copyable_v<RaySegment>);

/// Whether all numbers are finite, the step is 0 or more, and the direction of length 1.
bool is_valid(const RaySegment& segment);

/// A lattice's orders as rays of nodes, PHYSICS §13 "streak": the orders (m, k), 2 (m, k) … of one direction are a
/// straight grating's. A node sees the light around s_p = u − v_p, blurred along the ray.
struct LatticeStreak {
    double pitch_nm = 0.0;
    double deviation = 0.0;  ///< of a node along its ray, in units of u
    std::vector<RaySegment> segments;
};

/// The brightest rays, as many as hold 99 % of the light or kMostStreakSegments segments; their weights are scaled
/// to the light of all.
LatticeStreak make_lattice_streak(const Grating& grating, const StreakSettings& settings);

/// The map that its nodes look up.
StreakMapSize lattice_map_size(int map_resolution);

/// The nodes that one pixel reads at most.
inline int most_seen_nodes(const LatticeStreak& streak) {
    return kSegmentNodes * static_cast<int>(streak.segments.size());
}

/// XYZ for the tangent-frame view, as evaluate() of a Streak. Light below the horizon is black.
glm::dvec3 evaluate(const LatticeStreak& streak, const StreakMap& map, const glm::dmat3& axes, const glm::dvec3& view,
                    const std::optional<Cover>& cover = std::nullopt);

void write(const LatticeStreak& streak, ByteWriter& writer);
/// Throws Error (input) for invalid bytes, or more than kMostStreakSegments segments.
LatticeStreak read_lattice_streak(ByteReader& reader);

}  // namespace rowland::diffraction
