#pragma once

#include "modules/diffraction/representations/streak/streak_map.h"

namespace rowland::diffraction::test {

/// Radiance 1 everywhere.
inline StreakMap even_streak_map(const StreakMapSize& size) {
    StreakMap map{.size = size, .levels = {}};
    for (int level = 0; level < kStreakLevels; ++level)
        map.levels[static_cast<std::size_t>(level)].assign(map.index(level, map.slices(level), 0, 0), glm::vec3(1.0F));
    return map;
}

}  // namespace rowland::diffraction::test
