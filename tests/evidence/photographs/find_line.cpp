#include "tests/evidence/photographs/find_line.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>

namespace rowland::evidence {

namespace {

constexpr int kAzimuths = 1440;              ///< samples around a circle
constexpr int kApart = kAzimuths / 180;      ///< 2°: the least distance of two lines
constexpr int kSpotsApart = 4;               ///< radii: the least distance of two spots
constexpr std::size_t kShortestLine = 5;     ///< radii
const double kSameLine = glm::radians(6.0);  ///< a line turns less than that from one radius to the next

double azimuth_of(double sample) {
    return 2.0 * std::numbers::pi * sample / kAzimuths;
}

/// The samples above half of that at `top`, as the first and one past the last; an index may lie beyond the ends of a
/// circle. nullopt: cut off, or a circle without an end.
struct Run {
    int begin;
    int end;
};
template <typename At>
std::optional<Run> above_half(const At& at, int top, int count) {
    const double half = 0.5 * *at(top);
    Run run{top, top + 1};
    while (at(run.begin - 1) && *at(run.begin - 1) > half && run.end - run.begin < count) --run.begin;
    while (at(run.end) && *at(run.end) > half && run.end - run.begin < count) ++run.end;
    if (!at(run.begin - 1) || !at(run.end) || run.end - run.begin >= count) return std::nullopt;
    return run;
}

/// A line of the picture from radius to radius.
struct Line {
    std::size_t first_radius = 0;
    std::vector<Crossing> crossings;
};

void extend(std::vector<Line>& lines, std::size_t radius, const Crossing& crossing) {
    for (Line& line : lines)
        if (line.first_radius + line.crossings.size() == radius &&
            azimuth_difference(line.crossings.back().azimuth, crossing.azimuth) < kSameLine) {
            line.crossings.push_back(crossing);
            return;
        }
    lines.push_back({.first_radius = radius, .crossings = {crossing}});
}

Spot spot_at(const Line& line, double position) {
    const auto below = std::min(static_cast<std::size_t>(position), line.crossings.size() - 2);
    const double t = position - static_cast<double>(below);
    const double from = line.crossings[below].azimuth;
    const double to = line.crossings[below + 1].azimuth;
    return {.radius_m = kInnermost_m + kRadiusStep_m * (static_cast<double>(line.first_radius) + position),
            .azimuth = from + t * std::remainder(to - from, 2.0 * std::numbers::pi)};
}

}  // namespace

std::vector<Peak> peaks(std::span<const double> samples, double threshold, int apart, bool around) {
    const int count = static_cast<int>(samples.size());
    const auto at = [&](int i) -> std::optional<double> {
        if (around) i = (i % count + count) % count;
        if (i < 0 || i >= count) return std::nullopt;
        return samples[static_cast<std::size_t>(i)];
    };
    std::vector<int> tops;
    for (int i = 0; i < count; ++i) {
        bool top = *at(i) >= threshold && *at(i) > 0.0;
        for (int k = 1; k <= apart && top; ++k)
            top = at(i - k).value_or(0.0) < *at(i) && at(i + k).value_or(0.0) <= *at(i);
        if (top) tops.push_back(i);
    }
    std::ranges::sort(tops, [&](int a, int b) { return *at(a) > *at(b); });
    std::vector<Peak> result;
    for (const int top : tops) {
        const std::optional<Run> run = above_half(at, top, count);
        if (!run) continue;
        double weight = 0.0;
        double moment = 0.0;
        for (int i = run->begin; i < run->end; ++i) {
            const double excess = *at(i) - 0.5 * *at(top);
            weight += excess;
            moment += excess * (i - top);
        }
        result.push_back({.position = top + moment / weight, .excess = weight});
    }
    return result;
}

std::vector<Crossing> find_crossings(const DrawnPicture& picture, double radius_m, double threshold) {
    std::vector<double> circle;
    circle.reserve(kAzimuths);
    for (int i = 0; i < kAzimuths; ++i) circle.push_back(picture.brightness(disc_point(radius_m, azimuth_of(i))));
    std::vector<Crossing> crossings;
    for (const Peak& peak : peaks(circle, threshold, kApart, true))
        crossings.push_back({.azimuth = azimuth_of(peak.position), .brightness = peak.excess * radius_m});
    return crossings;
}

std::vector<Spot> find_spots(const DrawnPicture& picture, double threshold) {
    if (picture.greatest_brightness() < threshold) return {};
    std::vector<Line> lines;
    const auto radii = static_cast<std::size_t>(std::lround((kOutermost_m - kInnermost_m) / kRadiusStep_m)) + 1;
    for (std::size_t i = 0; i < radii; ++i)
        for (const Crossing& crossing :
             find_crossings(picture, kInnermost_m + kRadiusStep_m * static_cast<double>(i), threshold))
            extend(lines, i, crossing);
    std::vector<Spot> spots;
    for (const Line& line : lines) {
        if (line.crossings.size() < kShortestLine) continue;
        std::vector<double> along;
        for (const Crossing& crossing : line.crossings) along.push_back(crossing.brightness);
        for (const Peak& peak : peaks(along, 0.0, kSpotsApart, false)) spots.push_back(spot_at(line, peak.position));
    }
    return spots;
}

}  // namespace rowland::evidence
