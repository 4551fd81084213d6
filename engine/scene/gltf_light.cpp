#include "engine/scene/gltf_light.h"

#include <fmt/format.h>

#include <numbers>
#include <optional>

#include "engine/core/json_reader.h"
#include "engine/scene/gltf_index.h"

namespace rowland::scene {

namespace {

const char* const kExtension = "KHR_lights_punctual";
// The sun has 1e5 lux; a light of more than a million suns is a mistake.
constexpr NumberRange kIntensity{.minimum = 0.0, .maximum = 1e12};
constexpr NumberRange kColour{.minimum = 0.0, .maximum = 1e6};
constexpr NumberRange kRange{.minimum = 0.0, .maximum = 1e12, .minimum_open = true};
constexpr NumberRange kInnerCone{.minimum = 0.0, .maximum = std::numbers::pi / 2.0, .maximum_open = true};

/// The extension's object of `owner`, if it is there.
std::optional<JsonReader> extension_of(JsonReader& owner) {
    if (!owner.has("extensions")) return std::nullopt;
    JsonReader extensions = owner.object("extensions");
    if (!extensions.has(kExtension)) return std::nullopt;
    return extensions.object(kExtension);
}

glm::vec3 read_strength(JsonReader& light) {
    glm::dvec3 colour(1.0);
    if (light.has("color")) {
        const std::vector<double> given = light.numbers("color", 3, kColour);
        colour = {given[0], given[1], given[2]};
    }
    return glm::vec3(colour * light.number_or("intensity", 1.0, kIntensity));
}

void read_cones(JsonReader& light, PunctualLight& spot) {
    JsonReader cones = light.object("spot");
    const double inner = cones.number_or("innerConeAngle", 0.0, kInnerCone);
    // Exporters write π / 2 in digits that may round up.
    const NumberRange outer{.minimum = inner, .maximum = std::numbers::pi / 2.0 + 1e-6, .minimum_open = true};
    spot.inner_cone = static_cast<float>(inner);
    spot.outer_cone = static_cast<float>(cones.number_or("outerConeAngle", std::numbers::pi / 4.0, outer));
    // The default angle may be the one that is too small, or the two may be one float.
    if (!(spot.outer_cone > spot.inner_cone))
        cones.fail("outerConeAngle", fmt::format("{}", spot.outer_cone),
                   fmt::format("more than the inner angle, {}", spot.inner_cone));
}

GltfLight read_light(JsonReader& light) {
    text_if_there(light, "name");
    const std::string type = light.choice("type", {"directional", "point", "spot"});
    const glm::vec3 strength = read_strength(light);
    // It shines along the node's −Z.
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

std::vector<GltfLight> read_lights(const nlohmann::json& json, const std::string& file) {
    std::vector<GltfLight> lights;
    JsonReader root(json, file);
    std::optional<JsonReader> extension = extension_of(root);
    if (!extension) return lights;
    for (JsonReader& light : extension->objects("lights")) lights.push_back(read_light(light));
    return lights;
}

void read_node_lights(const nlohmann::json& json, const std::string& file, std::span<GltfNode> nodes,
                      std::size_t light_count) {
    std::size_t i = 0;
    for (JsonReader& node : root_objects(json, file, "nodes")) {
        GltfNode& to = nodes[i++];
        std::optional<JsonReader> extension = extension_of(node);
        if (!extension) continue;
        if (light_count == 0) extension->fail("light", "a light", "none: the file has no lights");
        to.light = static_cast<std::size_t>(extension->integer("light", 0, static_cast<std::int64_t>(light_count) - 1));
    }
}

}  // namespace rowland::scene
