#include "engine/post/false_colour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rowland::post {

glm::dvec3 false_colour(double stops) {
    constexpr int kEnd = 6;
    constexpr std::array<glm::dvec3, 2 * kEnd + 1> kColours{{{0.0, 0.0, 0.0},
                                                             {0.05, 0.0, 0.12},
                                                             {0.12, 0.0, 0.4},
                                                             {0.0, 0.03, 0.7},
                                                             {0.0, 0.2, 0.6},
                                                             {0.0, 0.35, 0.4},
                                                             {0.18, 0.18, 0.18},
                                                             {0.02, 0.35, 0.05},
                                                             {0.25, 0.6, 0.02},
                                                             {0.9, 0.8, 0.02},
                                                             {1.0, 0.3, 0.0},
                                                             {0.8, 0.0, 0.0},
                                                             {1.0, 1.0, 1.0}}};
    const int stop = static_cast<int>(std::lround(std::clamp(stops, -1.0 * kEnd, 1.0 * kEnd)));
    return kColours[static_cast<std::size_t>(stop + kEnd)];
}

}  // namespace rowland::post
