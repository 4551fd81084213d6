#pragma once

#include <vector>

#include "engine/lighting/key_lights.h"

namespace rowland::web {

/// Numbers of a key light as workers hand them on: direction, flux, concentration.
inline constexpr int kKeyLightNumbers = 7;

inline std::vector<lighting::KeyLight> key_lights_of(const float* numbers, int count) {
    std::vector<lighting::KeyLight> lights;
    for (const float* at = numbers; at != numbers + kKeyLightNumbers * count; at += kKeyLightNumbers)
        lights.push_back({.direction = {at[0], at[1], at[2]},
                          .flux = {at[3], at[4], at[5]},
                          .concentration = static_cast<double>(at[6])});
    return lights;
}

}  // namespace rowland::web
