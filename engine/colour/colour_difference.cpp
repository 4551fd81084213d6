#include "engine/colour/colour_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <utility>

#include "engine/colour/colour_space.h"
#include "engine/core/check.h"
#include "engine/core/parallel.h"

namespace rowland::colour {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// f of CIELAB.
double lightness_curve(double ratio) {
    constexpr double kLinearBelow = 216.0 / 24389.0;
    constexpr double kSlope = 24389.0 / 27.0;
    return ratio > kLinearBelow ? std::cbrt(ratio) : (kSlope * ratio + 16.0) / 116.0;
}

double seventh_power_ratio(double chroma) {
    const double c7 = std::pow(chroma, 7.0);
    return std::sqrt(c7 / (c7 + std::pow(25.0, 7.0)));
}

/// The hue angle in [0, 2π); 0 for greys.
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
    const double delta_theta = 30.0 * kDegree * std::exp(-from_blue * from_blue);
    const double r_t = -std::sin(2.0 * delta_theta) * 2.0 * seventh_power_ratio(c);

    const double x = delta_l / s_l;
    const double y = delta_c / s_c;
    const double z = delta_h / s_h;
    return std::sqrt(x * x + y * y + z * z + r_t * y * z);
}

namespace {

using std::numbers::pi;

/// One channel of a picture, row by row.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<double> values;

    Plane(int columns, int rows)
        : width(columns), height(rows), values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}
};

/// Weights of pixels -r to r.
using Kernel = std::vector<double>;

Kernel gaussian(double deviation, int radius) {
    Kernel kernel;
    double sum = 0.0;
    for (int x = -radius; x <= radius; ++x) {
        kernel.push_back(std::exp(-0.5 * x * x / (deviation * deviation)));
        sum += kernel.back();
    }
    for (double& weight : kernel) weight /= sum;
    return kernel;
}

/// Separable convolution; beyond the edges the nearest pixel is repeated.
Plane filtered(const Plane& plane, const Kernel& horizontal, const Kernel& vertical) {
    const auto along = [](const Plane& from, const Kernel& kernel, bool rows) {
        Plane to(from.width, from.height);
        const int radius = static_cast<int>(kernel.size() / 2);
        for (int y = 0; y < from.height; ++y)
            for (int x = 0; x < from.width; ++x) {
                double sum = 0.0;
                for (int i = -radius; i <= radius; ++i) {
                    const int column = rows ? std::clamp(x + i, 0, from.width - 1) : x;
                    const int row = rows ? y : std::clamp(y + i, 0, from.height - 1);
                    sum += kernel[static_cast<std::size_t>(i + radius)] *
                           from.values[static_cast<std::size_t>(row * from.width + column)];
                }
                to.values[static_cast<std::size_t>(y * from.width + x)] = sum;
            }
        return to;
    };
    return along(along(plane, horizontal, true), vertical, false);
}

/// Contrast sensitivity of a channel: the sum of two Gaussians a √(π/b) exp(−π² x²/b), x in degrees.
struct Sensitivity {
    std::array<double, 2> a;
    std::array<double, 2> b;
};
constexpr std::array<Sensitivity, 3> kSensitivities = {
    {{{1.0, 0.0}, {0.0047, 1e-5}}, {{1.0, 0.0}, {0.0053, 1e-5}}, {{34.1, 13.5}, {0.04, 0.025}}}};
constexpr double kLargestB = 0.04;

Plane apply_sensitivity(const Plane& plane, const Sensitivity& sensitivity, double pixels_per_degree) {
    const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(kLargestB / (2.0 * pi * pi)) * pixels_per_degree));
    Plane sum(plane.width, plane.height);
    double weights = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        if (sensitivity.a[i] == 0.0) continue;
        const double deviation = std::sqrt(sensitivity.b[i] / (2.0 * pi * pi)) * pixels_per_degree;
        const Kernel kernel = gaussian(deviation, radius);
        // 1 over the sum of the weights before they were normalised, since the middle one was 1.
        const double middle = kernel[static_cast<std::size_t>(radius)];
        const double weight = sensitivity.a[i] * std::sqrt(pi / sensitivity.b[i]) / (middle * middle);
        const Plane part = filtered(plane, kernel, kernel);
        for (std::size_t p = 0; p < sum.values.size(); ++p) sum.values[p] += weight * part.values[p];
        weights += weight;
    }
    for (double& value : sum.values) value /= weights;
    return sum;
}

glm::dvec3 white() {
    return rec709_to_xyz() * glm::dvec3(1.0);
}

/// YCxCz, linear in XYZ: CIELAB without its cube root.
glm::dvec3 to_ycxcz(const glm::dvec3& rgb) {
    const glm::dvec3 relative = rec709_to_xyz() * rgb / white();
    return {116.0 * relative.y - 16.0, 500.0 * (relative.x - relative.y), 200.0 * (relative.y - relative.z)};
}

glm::dvec3 from_ycxcz(const glm::dvec3& opponent) {
    const double y = (opponent.x + 16.0) / 116.0;
    static const glm::dmat3 kToRgb = glm::inverse(rec709_to_xyz());
    return kToRgb * (white() * glm::dvec3(opponent.y / 500.0 + y, y, y - opponent.z / 200.0));
}

/// CIELAB whose chroma is proportional to the lightness (Hunt effect).
glm::dvec3 adjusted_lab(const glm::dvec3& rgb) {
    const glm::dvec3 lab = xyz_to_lab(rec709_to_xyz() * rgb, white());
    return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

/// The HyAB distance: lightness by difference, chroma by Euclidean distance.
double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// A power of the HyAB distance, mapped to [0, 1] by two linear parts.
double colour_difference(const glm::dvec3& a, const glm::dvec3& b) {
    constexpr double kExponent = 0.7;
    constexpr double kKnee = 0.4;  // of the largest difference
    constexpr double kKneeValue = 0.95;
    static const double kLargest =
        std::pow(hyab(adjusted_lab({0.0, 1.0, 0.0}), adjusted_lab({0.0, 0.0, 1.0})), kExponent);
    const double difference = std::pow(hyab(a, b), kExponent);
    const double knee = kKnee * kLargest;
    if (difference < knee) return difference * kKneeValue / knee;
    return kKneeValue + (difference - knee) / (kLargest - knee) * (1.0 - kKneeValue);
}

/// How strong edges and points are at each pixel of a luminance in [0, 1].
struct Features {
    std::vector<double> edges;
    std::vector<double> points;
};

Features features(const Plane& luminance, double pixels_per_degree) {
    constexpr double kWidth_degrees = 0.082;
    const double deviation = 0.5 * kWidth_degrees * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0 * deviation));
    const Kernel smooth = gaussian(deviation, radius);
    // Derivatives whose positive and negative weights each sum to 1.
    const auto derivative = [&](auto&& shape) {
        Kernel kernel;
        double positive = 0.0;
        double negative = 0.0;
        for (int x = -radius; x <= radius; ++x) {
            kernel.push_back(shape(x / deviation) * std::exp(-0.5 * x * x / (deviation * deviation)));
            (kernel.back() > 0.0 ? positive : negative) += std::abs(kernel.back());
        }
        for (double& weight : kernel) weight /= weight > 0.0 ? positive : negative;
        return kernel;
    };
    const auto magnitude = [&](const Kernel& kernel) {
        const Plane across = filtered(luminance, kernel, smooth);
        const Plane down = filtered(luminance, smooth, kernel);
        std::vector<double> result;
        for (std::size_t i = 0; i < across.values.size(); ++i)
            result.push_back(std::hypot(across.values[i], down.values[i]));
        return result;
    };
    return {.edges = magnitude(derivative([](double x) { return -x; })),
            .points = magnitude(derivative([](double x) { return x * x - 1.0; }))};
}

/// What ꟻLIP compares of a picture.
struct Seen {
    std::vector<glm::dvec3> lab;
    Features features;
};

Seen as_seen(std::span<const glm::dvec3> picture, int width, int height, double pixels_per_degree) {
    std::array<Plane, 3> planes{Plane(width, height), Plane(width, height), Plane(width, height)};
    Plane luminance(width, height);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const glm::dvec3 opponent = to_ycxcz(picture[i]);
        for (int c = 0; c < 3; ++c) planes[static_cast<std::size_t>(c)].values[i] = opponent[c];
        luminance.values[i] = (opponent.x + 16.0) / 116.0;
    }
    for (std::size_t c = 0; c < 3; ++c) planes[c] = apply_sensitivity(planes[c], kSensitivities[c], pixels_per_degree);
    Seen result{.lab = {}, .features = features(luminance, pixels_per_degree)};
    for (std::size_t i = 0; i < picture.size(); ++i)
        result.lab.push_back(adjusted_lab(
            glm::clamp(from_ycxcz({planes[0].values[i], planes[1].values[i], planes[2].values[i]}), 0.0, 1.0)));
    return result;
}

/// Narkowicz' fit of the ACES curve at 0.6 x, as the coefficients of (a x² + b x) / (c x² + d x + e).
constexpr double kToneA = 0.36 * 2.51, kToneB = 0.6 * 0.03, kToneC = 0.36 * 2.43, kToneD = 0.6 * 0.59, kToneE = 0.14;

std::vector<glm::dvec3> exposed(std::span<const glm::dvec3> rgb, double factor) {
    std::vector<glm::dvec3> result;
    for (const glm::dvec3& value : rgb) {
        const glm::dvec3 x = factor * glm::max(value, 0.0);
        result.push_back(glm::clamp((kToneA * x * x + kToneB * x) / (kToneC * x * x + kToneD * x + kToneE), 0.0, 1.0));
    }
    return result;
}

/// The value that the curve maps to `to`.
double inverse_tone(double to) {
    const double a = kToneA - to * kToneC;
    const double b = kToneB - to * kToneD;
    return (-b + std::sqrt(b * b + 4.0 * a * to * kToneE)) / (2.0 * a);
}

std::vector<glm::dvec3> to_rec709(std::span<const glm::dvec3> xyz) {
    const glm::dmat3 to_rgb = glm::inverse(rec709_to_xyz());
    std::vector<glm::dvec3> rgb;
    for (const glm::dvec3& value : xyz) rgb.push_back(to_rgb * value);
    return rgb;
}

/// Exposures from the one that shows the largest luminance to the one that shows the median, evenly spaced in stops: as
/// many as the stops between them, rounded up, but at least two.
std::vector<double> exposure_factors(std::span<const glm::dvec3> reference) {
    constexpr double kShown = 0.85;  // of the display's white
    std::vector<double> luminances;
    for (const glm::dvec3& xyz : reference)
        if (xyz.y > 0.0) luminances.push_back(xyz.y);
    if (luminances.empty()) return {};
    std::ranges::sort(luminances);
    const std::size_t half = luminances.size() / 2;
    const double median =
        luminances.size() % 2 == 1 ? luminances[half] : 0.5 * (luminances[half - 1] + luminances[half]);
    const double first = std::log2(inverse_tone(kShown) / luminances.back());
    const double last = std::log2(inverse_tone(kShown) / median);
    const int count = std::max(2, static_cast<int>(std::ceil(last - first)));
    std::vector<double> factors;
    for (int i = 0; i < count; ++i) factors.push_back(std::exp2(first + (last - first) * i / (count - 1)));
    return factors;
}

}  // namespace

std::vector<double> flip(std::span<const glm::dvec3> picture, std::span<const glm::dvec3> reference, int width,
                         int height, double pixels_per_degree) {
    ROWLAND_CHECK_OP(picture.size(), ==, reference.size());
    ROWLAND_CHECK_OP(picture.size(), ==, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const Seen a = as_seen(picture, width, height, pixels_per_degree);
    const Seen b = as_seen(reference, width, height, pixels_per_degree);
    std::vector<double> result;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const double of_features = std::max(std::abs(a.features.edges[i] - b.features.edges[i]),
                                            std::abs(a.features.points[i] - b.features.points[i]));
        const double feature_difference = std::sqrt(of_features / std::numbers::sqrt2);
        result.push_back(std::pow(colour_difference(a.lab[i], b.lab[i]), 1.0 - feature_difference));
    }
    return result;
}

std::vector<double> hdr_flip(std::span<const glm::dvec3> picture, std::span<const glm::dvec3> reference, int width,
                             int height, double pixels_per_degree) {
    const std::vector<glm::dvec3> shown = to_rec709(picture);
    const std::vector<glm::dvec3> true_rgb = to_rec709(reference);
    const std::vector<double> factors = exposure_factors(reference);
    std::vector<std::vector<double>> maps(factors.size());
    parallel_for(factors.size(), [&](std::size_t i) {
        maps[i] = flip(exposed(shown, factors[i]), exposed(true_rgb, factors[i]), width, height, pixels_per_degree);
    });
    std::vector<double> largest(reference.size(), 0.0);
    for (const std::vector<double>& map : maps)
        for (std::size_t i = 0; i < largest.size(); ++i) largest[i] = std::max(largest[i], map[i]);
    return largest;
}

}  // namespace rowland::colour
