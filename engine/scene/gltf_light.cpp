#include <fmt/format.h>

#include <numbers>

#include "engine/scene/gltf_parts.h"

namespace rowland::scene {

namespace {

// The sun has 1e5 lux; a light of more than a million suns is a mistake.
constexpr NumberRange kIntensity{.minimum = 0.0, .maximum = 1e12};
constexpr NumberRange kColour{.minimum = 0.0, .maximum = 1e6};
constexpr NumberRange kRange{.minimum = 0.0, .maximum = 1e12, .minimum_open = true};
constexpr NumberRange kInnerCone{.minimum = 0.0, .maximum = std::numbers::pi / 2.0, .maximum_open = true};

glm::vec3 read_strength(JsonReader& light) {
    return glm::vec3(read_vector_or(light, "color", glm::dvec3(1.0), kColour) *
                     light.number_or("intensity", 1.0, kIntensity));
}

void read_cones(JsonReader& light, PunctualLight& spot) {
    JsonReader cones = light.object("spot");
    const double inner = cones.number_or("innerConeAngle", 0.0, kInnerCone);
    // Exporters write π / 2 in digits that may round up.
    const NumberRange outer{.minimum = inner, .maximum = std::numbers::pi / 2.0 + 1e-6, .minimum_open = true};
    spot.inner_cone = static_cast<float>(inner);
    spot.outer_cone = static_cast<float>(cones.number_or("outerConeAngle", std::numbers::pi / 4.0, outer));
    // The default angle may be too small, or the two may round to one float.
    if (!(spot.outer_cone > spot.inner_cone))
        cones.fail("outerConeAngle", fmt::format("{}", spot.outer_cone),
                   fmt::format("more than the inner angle, {}", spot.inner_cone));
}

GltfLight read_light(JsonReader& light) {
    light.text_or("name", "");
    const std::string type = light.choice("type", {"directional", "point", "spot"});
    const glm::vec3 strength = read_strength(light);
    // Along the node's −Z.
    if (type == "directional")
        return DirectionalLight{.direction = {0.0F, 0.0F, 1.0F}, .irradiance = strength, .casts_shadow = false};
    PunctualLight punctual;
    punctual.intensity = strength;
    if (light.has("range")) punctual.range_m = static_cast<float>(light.number("range", kRange));
    punctual.spot = type == "spot";
    if (punctual.spot) read_cones(light, punctual);
    return punctual;
}

}  // namespace

std::vector<GltfLight> read_lights(const GltfJson& json) {
    std::vector<GltfLight> lights;
    JsonReader root(json.root, json.file);
    if (auto extension = extension_of(root, kLightExtension))
        for (JsonReader& light : extension->objects("lights")) lights.push_back(read_light(light));
    return lights;
}

}  // namespace rowland::scene
