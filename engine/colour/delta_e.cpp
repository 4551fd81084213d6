#include "engine/colour/delta_e.h"

#include <cmath>
#include <numbers>

namespace rowland::colour {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double lightness_curve(double ratio) {
    constexpr double kLinearBelow = 216.0 / 24389.0;
    constexpr double kSlope = 24389.0 / 27.0;
    return ratio > kLinearBelow ? std::cbrt(ratio) : (kSlope * ratio + 16.0) / 116.0;
}

double seventh_power_ratio(double chroma) {
    const double c7 = std::pow(chroma, 7.0);
    return std::sqrt(c7 / (c7 + std::pow(25.0, 7.0)));
}

/// [0, 2π); 0 for greys.
double hue(double a, double b) {
    if (a == 0.0 && b == 0.0) return 0.0;
    const double angle = std::atan2(b, a);
    return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

/// The shorter way round from h1 to h2.
double hue_difference(double h1, double h2) {
    double difference = h2 - h1;
    if (difference > std::numbers::pi) difference -= 2.0 * std::numbers::pi;
    if (difference < -std::numbers::pi) difference += 2.0 * std::numbers::pi;
    return difference;
}

double mean_hue(double h1, double h2) {
    if (std::abs(h1 - h2) <= std::numbers::pi) return 0.5 * (h1 + h2);
    const double sum = h1 + h2;
    return 0.5 * (sum < 2.0 * std::numbers::pi ? sum + 2.0 * std::numbers::pi : sum - 2.0 * std::numbers::pi);
}

}  // namespace

glm::dvec3 xyz_to_lab(const glm::dvec3& xyz, const glm::dvec3& white) {
    const glm::dvec3 f(lightness_curve(xyz.x / white.x), lightness_curve(xyz.y / white.y),
                       lightness_curve(xyz.z / white.z));
    return {116.0 * f.y - 16.0, 500.0 * (f.x - f.y), 200.0 * (f.y - f.z)};
}

// Symbols as in Sharma, Wu & Dalal, eq. 2 to 22.
double delta_e_2000(const glm::dvec3& lab_1, const glm::dvec3& lab_2) {
    const double mean_chroma = 0.5 * (std::hypot(lab_1.y, lab_1.z) + std::hypot(lab_2.y, lab_2.z));
    const double stretch = 1.0 + 0.5 * (1.0 - seventh_power_ratio(mean_chroma));
    const double a1 = stretch * lab_1.y;
    const double a2 = stretch * lab_2.y;
    const double c1 = std::hypot(a1, lab_1.z);
    const double c2 = std::hypot(a2, lab_2.z);
    const double h1 = hue(a1, lab_1.z);
    const double h2 = hue(a2, lab_2.z);
    const bool grey = c1 * c2 == 0.0;

    const double delta_l = lab_2.x - lab_1.x;
    const double delta_c = c2 - c1;
    const double delta_h = grey ? 0.0 : 2.0 * std::sqrt(c1 * c2) * std::sin(0.5 * hue_difference(h1, h2));

    const double l = 0.5 * (lab_1.x + lab_2.x);
    const double c = 0.5 * (c1 + c2);
    const double h = grey ? h1 + h2 : mean_hue(h1, h2);
    const double t = 1.0 - 0.17 * std::cos(h - 30.0 * kDegree) + 0.24 * std::cos(2.0 * h) +
                     0.32 * std::cos(3.0 * h + 6.0 * kDegree) - 0.20 * std::cos(4.0 * h - 63.0 * kDegree);
    const double from_middle = (l - 50.0) * (l - 50.0);
    const double s_l = 1.0 + 0.015 * from_middle / std::sqrt(20.0 + from_middle);
    const double s_c = 1.0 + 0.045 * c;
    const double s_h = 1.0 + 0.015 * c * t;
    const double from_blue = (h / kDegree - 275.0) / 25.0;
    const double turn = 30.0 * kDegree * std::exp(-from_blue * from_blue);
    const double r_t = -std::sin(2.0 * turn) * 2.0 * seventh_power_ratio(c);

    const double x = delta_l / s_l;
    const double y = delta_c / s_c;
    const double z = delta_h / s_h;
    return std::sqrt(x * x + y * y + z * z + r_t * y * z);
}

}  // namespace rowland::colour
