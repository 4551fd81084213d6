#pragma once

#include <glm/mat3x3.hpp>

namespace rowland::post {

/// AgX, a filmic rendering whose channels mix toward white [Sobotka 2022, AgX]: linear Rec.709 → agx_inset() → the
/// base-2 logarithm, agx_least_stop to agx_most_stop as 0 to 1 → agx_curve() → the inverse of agx_inset() → display
/// values of a gamma of 2.2.
glm::dmat3 agx_inset();

constexpr double agx_least_stop = -12.47393;  ///< log2: 10 stops below 0.18
constexpr double agx_most_stop = 4.026069;    ///< 6.5 stops above
constexpr double agx_gamma = 2.2;

/// The sigmoid of slope 2 through (10 / 16.5, 0.5) with a toe of power 3 and a shoulder of power 3.25; 0 to 1.
double agx_curve(double x);

}  // namespace rowland::post
