#include "engine/scene/lathe.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "engine/core/check.h"
#include "engine/scene/surface_grid.h"

namespace rowland::scene {

namespace {

struct Station {
    glm::dvec2 at;
    glm::dvec2 direction;  ///< unit, along the profile
    double way = 0.0;      ///< fraction of the profile's length up to here
};

/// Connected stations; the next strip begins with an edge.
using Strip = std::vector<Station>;

std::vector<Strip> straight_strips(std::span<const glm::dvec2> profile) {
    std::vector<Strip> strips;
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        const glm::dvec2 direction = glm::normalize(profile[i + 1] - profile[i]);
        strips.push_back({{profile[i], direction}, {profile[i + 1], direction}});
    }
    return strips;
}

/// The points with one more before and behind: mirrored at the axis, so that the curve meets it at a right angle, else
/// straight on.
std::vector<glm::dvec2> extended(std::span<const glm::dvec2> profile) {
    const auto beyond = [](const glm::dvec2& end, const glm::dvec2& inner) {
        return end.x == 0.0 ? glm::dvec2(-inner.x, inner.y) : 2.0 * end - inner;
    };
    std::vector<glm::dvec2> points = {beyond(profile[0], profile[1])};
    points.insert(points.end(), profile.begin(), profile.end());
    points.push_back(beyond(profile.back(), profile[profile.size() - 2]));
    return points;
}

/// A Catmull-Rom curve with the chords' lengths as parameter (Farin, Curves and Surfaces for CAGD, 5th ed., 8.3).
Strip smooth_strip(std::span<const glm::dvec2> profile, int steps) {
    const std::vector<glm::dvec2> p = extended(profile);
    const auto chord = [&](std::size_t i) { return glm::length(p[i + 1] - p[i]); };
    const auto slope = [&](std::size_t i) {
        const double before = chord(i - 1);
        const double after = chord(i);
        return ((p[i] - p[i - 1]) * (after / before) + (p[i + 1] - p[i]) * (before / after)) / (before + after);
    };
    Strip strip;
    for (std::size_t i = 1; i + 2 < p.size(); ++i) {
        const double h = chord(i);
        const glm::dvec2 m0 = slope(i) * h;
        const glm::dvec2 m1 = slope(i + 1) * h;
        for (int step = i == 1 ? 0 : 1; step <= steps; ++step) {
            const double t = static_cast<double>(step) / steps;
            const glm::dvec2 c2 = 3.0 * (p[i + 1] - p[i]) - 2.0 * m0 - m1;
            const glm::dvec2 c3 = 2.0 * (p[i] - p[i + 1]) + m0 + m1;
            const glm::dvec2 at = step == steps ? p[i + 1] : p[i] + t * (m0 + t * (c2 + t * c3));
            const glm::dvec2 derivative = m0 + t * (2.0 * c2 + t * 3.0 * c3);
            strip.push_back({{std::max(at.x, 0.0), at.y}, glm::normalize(derivative)});
        }
    }
    return strip;
}

void measure(std::vector<Strip>& strips) {
    double length = 0.0;
    for (Strip& strip : strips) {
        for (std::size_t i = 0; i < strip.size(); ++i) {
            if (i > 0) length += glm::length(strip[i].at - strip[i - 1].at);
            strip[i].way = length;
        }
    }
    for (Strip& strip : strips)
        for (Station& station : strip) station.way /= length;
}

class Turning {
 public:
    explicit Turning(const LatheRecipe& recipe) : recipe_(recipe) {}

    Mesh turn(const std::vector<Strip>& strips) {
        for (const Strip& strip : strips) {
            Row below = add_row(strip.front());
            for (std::size_t i = 1; i < strip.size(); ++i) {
                const Row above = add_row(strip[i]);
                connect(below, above);
                below = above;
            }
        }
        return std::move(mesh_);
    }

 private:
    /// The vertices around a station. On the axis there is one per sector, in the sector's middle, so that each
    /// triangle has its own tangent.
    struct Row {
        std::uint32_t first;
        bool on_axis;
    };

    /// `half_steps`: half sectors from where the turn begins.
    Angle at(int half_steps) const {
        if (recipe_.from_deg == 0.0 && recipe_.to_deg == 360.0) return angle(half_steps, 2 * recipe_.segments);
        const double turned = static_cast<double>(half_steps) / (2 * recipe_.segments);
        const double radians = std::lerp(recipe_.from_deg, recipe_.to_deg, turned) / 180.0 * std::numbers::pi;
        return {std::cos(radians), std::sin(radians)};
    }

    Row add_row(const Station& station) {
        const Row row{static_cast<std::uint32_t>(mesh_.positions.size()), station.at.x == 0.0};
        if (row.on_axis)
            for (int segment = 0; segment < recipe_.segments; ++segment) add_station(station, 2 * segment + 1);
        else
            for (int segment = 0; segment <= recipe_.segments; ++segment) add_station(station, 2 * segment);
        return row;
    }

    void add_station(const Station& station, int half_steps) {
        const auto [c, s] = at(half_steps);
        const double f = recipe_.flatten;
        const glm::dvec2 d = station.direction;
        const glm::dvec3 position(station.at.x * c, station.at.y, -f * station.at.x * s);
        const glm::dvec3 normal = glm::normalize(glm::dvec3(d.y * c, -d.x, -d.y * s / f));
        const double turned = static_cast<double>(half_steps) / (2 * recipe_.segments);
        if (recipe_.tangent == LatheRecipe::Tangent::Around)
            add_vertex(mesh_, position, normal, glm::normalize(glm::dvec3(-s, 0.0, -f * c)), {turned, station.way});
        else
            add_vertex(mesh_, position, normal, glm::normalize(glm::dvec3(d.x * c, d.y, -f * d.x * s)),
                       {station.way, 1.0 - turned});
    }

    void connect(const Row& below, const Row& above) {
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(recipe_.segments); ++i) {
            const std::uint32_t a = below.first + i;
            const std::uint32_t b = above.first + i;
            if (!below.on_axis) mesh_.indices.insert(mesh_.indices.end(), {a, a + 1, above.on_axis ? b : b + 1});
            if (!above.on_axis) mesh_.indices.insert(mesh_.indices.end(), {a, b + 1, b});
        }
    }

    const LatheRecipe& recipe_;
    Mesh mesh_;
};

}  // namespace

Mesh build_lathe(const LatheRecipe& recipe) {
    ROWLAND_CHECK_OP(recipe.profile.size(), >=, 2U);
    std::vector<Strip> strips;
    if (recipe.smooth)
        strips.push_back(smooth_strip(recipe.profile, recipe.steps));
    else
        strips = straight_strips(recipe.profile);
    measure(strips);
    return Turning(recipe).turn(strips);
}

Mesh build_sphere(const SphereRecipe& recipe) {
    Strip meridian;
    for (int ring = 0; ring <= recipe.rings; ++ring) {
        const double latitude = static_cast<double>(ring) / recipe.rings;
        const double polar = std::numbers::pi * (1.0 - latitude);
        const bool is_pole = ring == 0 || ring == recipe.rings;
        const glm::dvec2 outward(is_pole ? 0.0 : std::sin(polar), std::cos(polar));
        meridian.push_back({recipe.radius * outward, {-outward.y, outward.x}, latitude});
    }
    LatheRecipe lathe;
    lathe.segments = recipe.segments;
    return Turning(lathe).turn({meridian});
}

}  // namespace rowland::scene
