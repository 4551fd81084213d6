#pragma once

#include <glm/vec3.hpp>

#include "modules/diffraction/representations/circle/circle_map.h"
#include "modules/diffraction/representations/direct/lobe_table.h"
#include "modules/diffraction/representations/planar/lobe_map.h"
#include "modules/diffraction/representations/planar/planar_map.h"
#include "modules/diffraction/representations/streak/streak.h"

namespace rowland::diffraction {

/// Texture units take 8 bits of a position between texels, rounded or cut off: so far is it off on an axis, in texels.
inline constexpr double kPositionError = 1.0 / 256.0;

/// Tables that give the most by which such positions change look-ups of these ones. A texel holds the larger
/// difference to its neighbours on each axis, times kPositionError, summed over the axes.
PlanarMap filter_error(const PlanarMap& map);
LobeMap filter_error(const LobeMap& map);
LobeTable filter_error(const LobeTable& table);
/// With what ten bits round.
CircleMap filter_error(const CircleMap& map);

/// Between two levels the larger value counts.
StreakMap filter_error(const StreakMap& map);
/// The streak that sums the errors of its look-ups.
Streak filter_error(const Streak& streak);

}  // namespace rowland::diffraction
