#include "modules/diffraction/asset/quality_json.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "engine/colour/colour_json.h"
#include "engine/lighting/key_lights.h"
#include "modules/diffraction/asset/budget_record.h"

namespace rowland::diffraction {

namespace {

constexpr std::size_t kMostProbes = 16;
constexpr double kDefaultDeltaE = 3.0;

bool at_vertices(JsonReader& json, const char* key) {
    return json.choice_or(key, "pixels", {"pixels", "vertices"}) == "vertices";
}

/// A built-in illuminant, or one from a file, named as in the material.
colour::Illuminant parse_illuminant(JsonReader& json, const ReadNamed& read) {
    std::variant<colour::Illuminant, std::string> named = colour::read_illuminant(json, "the material");
    if (auto* builtin = std::get_if<colour::Illuminant>(&named)) return std::move(*builtin);
    const auto& name = std::get<std::string>(named);
    const NamedText file = read(name);
    colour::Illuminant illuminant = colour::parse_illuminant(file.text, file.file);
    illuminant.name = name;
    return illuminant;
}

MeasuredProbe parse_probe_image(JsonReader json) {
    MeasuredProbe probe{.file = json.text("image")};
    probe.mapping = lighting::parse_mapping(json.choice_or("mapping", "equirect", {"equirect", "angular"}));
    if (probe.file.empty()) json.fail("image", "an empty name", "an .hdr or .exr file");
    json.finish();
    return probe;
}

std::vector<MeasuredProbe> parse_probes(JsonReader& json) {
    const nlohmann::json& list = json.raw("probes");
    if (!list.is_array() || list.empty() || list.size() > kMostProbes)
        json.fail("probes", list.is_array() ? fmt::format("{} probes", list.size()) : "another type",
                  fmt::format("a list of 1 to {} probes", kMostProbes));
    std::vector<MeasuredProbe> probes;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string pointer = fmt::format("probes/{}", i);
        if (list[i].is_object()) {
            probes.push_back(parse_probe_image(JsonReader(list[i], json.file(), json.pointer_to(pointer))));
        } else if (list[i].is_string() && !list[i].get<std::string>().empty()) {
            probes.push_back({.file = list[i].get<std::string>()});
        } else {
            json.fail(pointer, list[i].is_string() ? "an empty name" : "another type",
                      "a probe recipe's name, or { \"image\": \"room.hdr\", \"mapping\": \"equirect\" }");
        }
    }
    return probes;
}

/// What max_error is, and the probes and the surface it is measured on, if the cooker chooses the representation.
void parse_measure(JsonReader& json, Quality& quality) {
    quality.measure = read_error_measure(json);
    if (quality.measure == ErrorMeasure::DeltaE && !json.has("max_error")) quality.max_error = kDefaultDeltaE;
    if (json.has("probes")) quality.probes = parse_probes(json);
    if (json.choice_or("surface", "flat", {"flat", "curved"}) == "curved") quality.surface = SurfaceShape::Curved;
}

}  // namespace

ReadSettings read_settings(JsonReader& json) {
    std::vector<std::string_view> names;
    for (const RepresentationInfo* info : representations()) names.emplace_back(info->name);
    const RepresentationInfo& info = *find_representation(json.choice("representation", names));
    return {info, SettingValues(info, json)};
}

namespace {

Quality pinned_quality(const ReadSettings& settings, const Grating& grating) {
    Quality quality;
    quality.pinned = make_representation(settings.info, settings.values, grating);
    quality.key_lights = settings.info.key_lights == KeyLightUse::OnRequest ? 0 : lighting::kMaximumKeyLights;
    return quality;
}

void read_key_lights(JsonReader& json, const RepresentationInfo& info, Quality& quality) {
    const bool always = info.key_lights == KeyLightUse::Always;
    // Files of earlier versions say whether there are any.
    if (json.has("key_lights") && json.raw("key_lights").is_boolean()) {
        const bool any = json.boolean_or("key_lights", always);
        if (always && !any) json.fail("key_lights", "false", "true with this representation", "or leave it out");
        quality.key_lights = any ? lighting::kMaximumKeyLights : 0;
        return;
    }
    const int least = always ? 1 : 0;
    quality.key_lights =
        static_cast<int>(json.integer_or("key_lights", quality.key_lights, least, lighting::kMaximumKeyLights));
}

}  // namespace

std::variant<Quality, Refusal> suited_quality(const nlohmann::json& settings, const Grating& grating) {
    if (auto refused = baked_refusal(grating)) return *std::move(refused);
    JsonReader json(settings, "settings");
    const ReadSettings read = read_settings(json);
    if (auto refused = refusal(read.info, read.values, grating)) return *std::move(refused);
    Quality quality = pinned_quality(read, grating);
    read_key_lights(json, read.info, quality);
    json.finish();
    return quality;
}

Quality parse_quality(JsonReader json, const Grating& grating, const ReadNamed& read) {
    Quality quality;
    colour::Illuminant illuminant = parse_illuminant(json, read);
    if (json.has("representation")) {
        const ReadSettings settings = read_settings(json);
        if (const auto refused = refusal(settings.info, settings.values, grating))
            json.fail(refused->key, refused->found, refused->expected, refused->remedy);
        quality = pinned_quality(settings, grating);
        read_key_lights(json, settings.info, quality);
        // Maps shade directional lights one by one even where they hold the key lights.
        if (quality.key_lights > 0 || settings.info.is_map) quality.lights_at_vertices = at_vertices(json, "lights_at");
        if (settings.info.is_map) quality.map_at_vertices = at_vertices(json, "map_at");
    } else {
        parse_measure(json, quality);
    }
    quality.max_error = json.number_or("max_error", quality.max_error, {.minimum = 0.0, .minimum_open = true});
    quality.illuminant = std::move(illuminant);
    json.finish();
    return quality;
}

}  // namespace rowland::diffraction
