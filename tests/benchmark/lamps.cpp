#include "tests/benchmark/lamps.h"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "engine/lighting/probe_image.h"
#include "engine/lighting/studio.h"

namespace rowland::benchmark {

namespace {

constexpr double kIrradiance = 2.0;  ///< of all lamps together, on surfaces that face them
constexpr double kHalfSize_deg = 3.0;
constexpr double kLowest = 0.25;  ///< sines of elevations
constexpr double kHighest = 0.95;
constexpr int kProbeWidth = 512;

/// Directions by the golden angle: spread evenly for any count.
glm::dvec3 lamp_direction(int lamp, int count) {
    const double y = kLowest + (kHighest - kLowest) * (lamp + 0.5) / count;
    const double azimuth = lamp * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - y * y);
    return {r * std::sin(azimuth), y, -r * std::cos(azimuth)};
}

}  // namespace

std::vector<scene::DirectionalLight> lamps(int count) {
    std::vector<scene::DirectionalLight> result;
    for (int lamp = 0; lamp < count; ++lamp)
        result.push_back({.direction = glm::vec3(lamp_direction(lamp, count)),
                          .irradiance = glm::vec3(static_cast<float>(kIrradiance / count))});
    return result;
}

lighting::LightProbe lamp_room(int count) {
    lighting::StudioRecipe room{
        .ceiling = glm::dvec3(0.05), .wall = glm::dvec3(0.04), .floor = glm::dvec3(0.03), .boxes = {}};
    const double solid_angle = std::pow(glm::radians(2.0 * kHalfSize_deg), 2.0);
    for (int lamp = 0; lamp < count; ++lamp) {
        const glm::dvec3 d = lamp_direction(lamp, count);
        room.boxes.push_back({.azimuth_deg = glm::degrees(std::atan2(d.x, -d.z)),
                              .elevation_deg = glm::degrees(std::asin(d.y)),
                              .half_width_deg = kHalfSize_deg,
                              .half_height_deg = kHalfSize_deg,
                              .radiance = glm::dvec3(kIrradiance / count / solid_angle)});
    }
    const lighting::ProbeImage picture(lighting::render_studio(room, kProbeWidth), lighting::Mapping::Equirectangular);
    lighting::LightProbeSettings settings;
    settings.key_lights = 0;
    return lighting::build_light_probe(picture, settings);
}

}  // namespace rowland::benchmark
