// Foil of one direction, of bands and strokes, and of circles about a centre.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "modules/diffraction/foil/grating.h"
#include "modules/diffraction/foil/pattern.h"

namespace rowland::diffraction::foil {

namespace {

/// A unit vector at an angle from the direction of u.
glm::dvec2 direction_at(double angle_deg) {
    const double angle = angle_deg * std::numbers::pi / 180.0;
    return {std::cos(angle), std::sin(angle)};
}

/// A width of which a whole number fits the area where that repeats.
double fitted(double width_mm, const Area& area) {
    return area.repeats ? area.width_mm / std::max(1.0, std::round(area.width_mm / width_mm)) : width_mm;
}

GrooveField pillars(const Pillars& type, const Foil& foil, const Area& area) {
    const double band_mm = fitted(type.band_mm * foil.scale, area);
    const glm::dvec2 across = direction_at(foil.direction_deg);
    return [=](int column, int row) {
        const double phase = fraction_of(glm::dot(area.position_mm(column, row), across) / band_mm);
        return Groove{0.5, std::pow(type.pitch_range, phase)};
    };
}

GrooveField radial(const Radial& type, const Area& area) {
    const glm::dvec2 centre = type.centre * glm::dvec2(area.width_mm, area.height_mm());
    const double turn = type.circles ? 0.0 : 0.5;  // g points away from the centre, or around it
    return [=](int column, int row) {
        const glm::dvec2 from = area.position_mm(column, row) - centre;
        return Groove{std::atan2(from.y, from.x) / std::numbers::pi + turn};
    };
}

/// A normally distributed number of variance 1 from two uniform ones [Box & Muller 1958].
double normal_number(double a, double b) {
    return std::sqrt(-2.0 * std::log(1.0 - a)) * std::cos(2.0 * std::numbers::pi * b);
}

GrooveField brushed(const Brushed& type, const Foil& foil, const Area& area) {
    const glm::dvec2 along = direction_at(foil.direction_deg);
    const double stroke_mm = std::max(type.stroke_mm * foil.scale, area.texel_mm());
    const double length_mm = type.length_mm * foil.scale;
    const std::uint32_t seed = foil.seed;
    return [=](int column, int row) {
        const glm::dvec2 at = area.position_mm(column, row);
        const auto line = static_cast<std::int64_t>(std::floor((at.y * along.x - at.x * along.y) / stroke_mm));
        const double shift = random_of_cell(0, line, seed + 2);
        const auto stroke = static_cast<std::int64_t>(std::floor(glm::dot(at, along) / length_mm + shift));
        const double angle_deg =
            type.spread_deg * normal_number(random_of_cell(stroke, line, seed), random_of_cell(stroke, line, seed + 1));
        return Groove{0.5 + angle_deg / 180.0};
    };
}

/// A zone plate: at the distance r from its centre d sin(atan(r/f)) = λ, so that light along the normal is sent to the
/// focus.
GrooveField lens(const Lens& type, const Foil& foil, const Area& area) {
    const glm::dvec2 centre = type.centre * glm::dvec2(area.width_mm, area.height_mm());
    const double focal_mm = type.focal_mm * foil.scale;
    const double pitch_nm = foil_grating(foil).pitch_nm;
    return [=](int column, int row) {
        const glm::dvec2 from = area.position_mm(column, row) - centre;
        const double sine = glm::length(from) / std::hypot(glm::length(from), focal_mm);
        const double pitch = kMiddleWavelength_nm / (std::max(sine, 1e-6) * pitch_nm);
        // The finest grooves that there are, and none where they would be too coarse.
        const double finest = kFinestOfLens * 2.0;
        return Groove{std::atan2(from.y, from.x) / std::numbers::pi, pitch > 2.0 ? 0.0 : std::max(pitch, finest)};
    };
}

}  // namespace

GrooveField curve_field(const Foil& foil, const Area& area) {
    if (const auto* type = std::get_if<Pillars>(&foil.type)) return pillars(*type, foil, area);
    if (const auto* type = std::get_if<Radial>(&foil.type)) return radial(*type, area);
    if (const auto* type = std::get_if<Brushed>(&foil.type)) return brushed(*type, foil, area);
    if (const auto* type = std::get_if<Lens>(&foil.type)) return lens(*type, foil, area);
    ROWLAND_CHECK(std::holds_alternative<Rainbow>(foil.type), "a type that needs no picture");
    return [](int, int) { return Groove{0.5}; };
}

}  // namespace rowland::diffraction::foil
