#include "tests/evidence/photographs/disc_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace rowland::evidence {

namespace {

constexpr double kCircle = 2.0 * std::numbers::pi;
constexpr std::size_t kScanSteps = 720;
constexpr double kScanStart = 0.0012;  ///< no root of a symmetric setup lies on a step

/// Steps of s_h + v_h around a circle are so fine that two roots never fall into one: as a function of the azimuth it
/// is a sine, changed a little by the nearness of the eye.
double bisect(const LampAndEye& setup, double radius_m, double low, double high) {
    const bool rises = along_track(setup, radius_m, low) < 0.0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        ((along_track(setup, radius_m, middle) < 0.0) == rises ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

glm::dvec3 at(const Station& station, double azimuth_deg) {
    const double from_normal = glm::radians(station.from_normal_deg);
    const double azimuth = glm::radians(azimuth_deg);
    return station.distance_m * glm::dvec3(std::sin(from_normal) * std::sin(azimuth), std::cos(from_normal),
                                           std::sin(from_normal) * std::cos(azimuth));
}

}  // namespace

LampAndEye lamp_and_eye(const Station& camera, double turned_deg) {
    return {.lamp = at(kLamp, turned_deg), .eye = at(camera, 0.0)};
}

glm::dvec3 disc_point(double radius_m, double azimuth) {
    return radius_m * glm::dvec3(std::sin(azimuth), 0.0, std::cos(azimuth));
}

double along_track(const LampAndEye& setup, double radius_m, double azimuth) {
    const glm::dvec3 point = disc_point(radius_m, azimuth);
    const glm::dvec3 track(std::cos(azimuth), 0.0, -std::sin(azimuth));
    return dot(track, normalize(setup.lamp - point) + normalize(setup.eye - point));
}

double across_tracks(const LampAndEye& setup, double radius_m, double azimuth) {
    const glm::dvec3 point = disc_point(radius_m, azimuth);
    return dot(disc_point(1.0, azimuth), normalize(setup.lamp - point) + normalize(setup.eye - point));
}

std::vector<double> line_azimuths(const LampAndEye& setup, double radius_m) {
    std::array<double, kScanSteps + 1> azimuths{};
    std::array<bool, kScanSteps + 1> below{};
    for (std::size_t i = 0; i <= kScanSteps; ++i) {
        azimuths.at(i) = kScanStart + kCircle * static_cast<double>(i) / kScanSteps;
        below.at(i) = i < kScanSteps ? along_track(setup, radius_m, azimuths.at(i)) < 0.0 : below.front();
    }
    std::vector<double> roots;
    for (std::size_t i = 0; i < kScanSteps; ++i)
        if (below.at(i) != below.at(i + 1))
            roots.push_back(std::fmod(bisect(setup, radius_m, azimuths.at(i), azimuths.at(i + 1)), kCircle));
    std::ranges::sort(roots);
    return roots;
}

double line_wavelength_nm(const LampAndEye& setup, double radius_m, double azimuth, double pitch_nm, int order) {
    return pitch_nm * std::abs(across_tracks(setup, radius_m, azimuth)) / order;
}

double azimuth_difference(double a, double b) {
    return std::abs(std::remainder(a - b, kCircle));
}

}  // namespace rowland::evidence
