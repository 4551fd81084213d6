#include "editor/trade/frame_sets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "editor/trade/inputs.h"

namespace rowland::trade {

namespace {

constexpr int kPoints = 120;
/// Points by this angle apart cover a circle evenly.
const double kGoldenAngle = std::numbers::pi * (3.0 - std::sqrt(5.0));
constexpr double kSameNormal = 1.0 - 1e-9;

double share(int i) {
    return (i + 0.5) / kPoints;
}

}  // namespace

std::size_t FrameSet::size() const {
    std::size_t count = 0;
    for (const auto& surface : surfaces) count += surface.size();
    return count;
}

std::vector<diffraction::Frame> all_frames(const FrameSet& set) {
    std::vector<diffraction::Frame> frames;
    for (const auto& surface : set.surfaces) frames.insert(frames.end(), surface.begin(), surface.end());
    return frames;
}

FrameSet tilted_cd_frames() {
    constexpr double kTilt = 35.0 * std::numbers::pi / 180.0;
    constexpr double kInnerRadius = 0.4;  // of the outer one, as a compact disc's
    const glm::dvec3 normal(0.0, std::cos(kTilt), std::sin(kTilt));
    const glm::dvec3 across(1.0, 0.0, 0.0);
    const glm::dvec3 down = glm::cross(across, normal);
    const glm::dvec3 eye = 2.0 * normal + 0.2 * across + 0.3 * down;
    std::vector<diffraction::Frame> frames;
    for (int i = 0; i < kPoints; ++i) {
        const double inner2 = kInnerRadius * kInnerRadius;
        const double radius = std::sqrt(inner2 + share(i) * (1.0 - inner2));
        const glm::dvec3 radial = std::cos(i * kGoldenAngle) * across + std::sin(i * kGoldenAngle) * down;
        frames.push_back({.view = glm::normalize(eye - radius * radial), .normal = normal, .grating = radial});
    }
    return {.name = "tilted_cd", .surfaces = {std::move(frames)}};
}

FrameSet sphere_frames() {
    const glm::dvec3 eye(0.0, 1.0, 4.0);
    const glm::dvec3 toward = glm::normalize(eye);
    const glm::dvec3 right(1.0, 0.0, 0.0);
    const glm::dvec3 up = glm::cross(toward, right);
    constexpr double kLeastViewCosine = 0.1;
    // A point of cosine c to the eye's direction sees the eye at a cosine that grows with c.
    const double distance = glm::length(eye);
    const auto view_cosine = [&](double c) {
        return (distance * c - 1.0) / std::sqrt(distance * distance - 2.0 * distance * c + 1.0);
    };
    double horizon = 1.0 / distance;
    while (view_cosine(horizon) < kLeastViewCosine) horizon += 1e-4;
    std::vector<diffraction::Frame> frames;
    for (int i = 0; i < kPoints; ++i) {
        const double c = 1.0 - share(i) * (1.0 - horizon);
        const double s = std::sqrt(1.0 - c * c);
        const glm::dvec3 n = c * toward + s * (std::cos(i * kGoldenAngle) * right + std::sin(i * kGoldenAngle) * up);
        frames.push_back({.view = glm::normalize(eye - n),
                          .normal = n,
                          .grating = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), n))});
    }
    return {.name = "sphere", .surfaces = {std::move(frames)}};
}

FrameSet frames_of_file(const std::string& name, const std::filesystem::path& path) {
    return {.name = name, .surfaces = {read_frames(path)}};
}

bool is_flat(const std::vector<diffraction::Frame>& surface) {
    if (surface.empty()) return true;
    const glm::dvec3 first = glm::normalize(surface.front().normal);
    return std::all_of(surface.begin(), surface.end(), [&](const diffraction::Frame& frame) {
        return glm::dot(first, glm::normalize(frame.normal)) > kSameNormal;
    });
}

}  // namespace rowland::trade
