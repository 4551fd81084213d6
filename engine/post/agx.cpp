#include "engine/post/agx.h"

#include <cmath>
#include <glm/matrix.hpp>

namespace rowland::post {

namespace {

constexpr double kPivotIn = 10.0 / 16.5;
constexpr double kPivotOut = 0.5;
constexpr double kSlope = 2.0;

/// One half of the curve, measured from the pivot: slope kSlope at 0, through the corner (width, height).
double half_curve(double distance, double width, double height, double power) {
    const double scale =
        std::pow(std::pow(kSlope * width, -power) * (std::pow(kSlope * width / height, power) - 1.0), -1.0 / power);
    const double term = kSlope * distance / scale;
    return scale * term / std::pow(1.0 + std::pow(term, power), 1.0 / power);
}

}  // namespace

glm::dmat3 agx_inset() {
    return glm::transpose(glm::dmat3(0.842479062253094, 0.0784335999999992, 0.0792237451477643,  //
                                     0.0423282422610123, 0.878468636469772, 0.0791661274605434,  //
                                     0.0423756549057051, 0.0784336, 0.879142973793104));
}

double agx_curve(double x) {
    if (x < kPivotIn) return kPivotOut - half_curve(kPivotIn - x, kPivotIn, kPivotOut, 3.0);
    return kPivotOut + half_curve(x - kPivotIn, 1.0 - kPivotIn, 1.0 - kPivotOut, 3.25);
}

}  // namespace rowland::post
