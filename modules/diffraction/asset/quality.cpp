#include "modules/diffraction/asset/quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

#include "engine/colour/illuminant.h"
#include "engine/colour/spectrum.h"
#include "engine/core/error.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_probe.h"

namespace rowland::diffraction {

namespace {

constexpr std::array<const char*, 3> kMeasureNames = {"relative_rms", "delta_e", "hdr_flip"};

constexpr NumberRange kNonNegative{.minimum = 0.0, .maximum = std::numeric_limits<double>::max()};

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
    MeasuredProbe probe{.file = json.file_name("image", "an .hdr or .exr file")};
    probe.mapping = lighting::parse_mapping(json.choice_or("mapping", "equirect", {"equirect", "angular"}));
    json.finish();
    return probe;
}

std::vector<MeasuredProbe> parse_probes(JsonReader& json) {
    if (json.is_recording_schema()) {
        parse_probe_image(json.objects("probes", 1, kMostProbes)[0]);
        json.also_allows("probes/items", R"({"type": "string", "minLength": 1})");
        return {};
    }
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

/// How max_error is measured, under which probes and on which surface, if the cooker chooses the representation.
void parse_measure(JsonReader& json, Quality& quality) {
    quality.measure = read_error_measure(json);
    if (!json.has("max_error")) quality.max_error = default_max_error(quality.measure);
    if (json.has("probes")) quality.probes = parse_probes(json);
    if (json.choice_or("surface", "flat", {"flat", "curved"}) == "curved") quality.surface = SurfaceShape::Curved;
}

std::vector<std::string_view> representation_names() {
    std::vector<std::string_view> names;
    for (const RepresentationInfo* info : representations()) names.emplace_back(info->name);
    return names;
}

Quality pinned_quality(const RepresentationInfo& info, const SettingValues& values, const Grating& grating) {
    Quality quality;
    quality.pinned = make_representation(info, values, grating);
    quality.key_lights = info.key_lights == KeyLightUse::OnRequest ? 0 : lighting::kMaximumKeyLights;
    return quality;
}

void read_key_lights(JsonReader& json, const RepresentationInfo& info, Quality& quality) {
    const bool always = info.key_lights == KeyLightUse::Always;
    // Files of earlier versions have a boolean.
    if (!json.is_recording_schema() && json.has("key_lights") && json.raw("key_lights").is_boolean()) {
        const bool any = json.boolean_or("key_lights", always);
        if (always && !any) json.fail("key_lights", "false", "true with this representation", "or leave it out");
        quality.key_lights = any ? lighting::kMaximumKeyLights : 0;
        return;
    }
    const int least = always && &info != &DirectSettings::info() ? 1 : 0;
    quality.key_lights =
        static_cast<int>(json.integer_or("key_lights", quality.key_lights, least, lighting::kMaximumKeyLights));
    json.also_allows("key_lights", always ? R"({"const": true})" : R"({"type": "boolean"})");
}

/// A representation with its settings; "representation" has been read.
Quality parse_pinned(JsonReader& json, const RepresentationInfo& info, const Grating& grating) {
    Quality quality;
    const SettingValues values(info, json);
    if (!json.is_recording_schema()) {
        if (const auto refused = refusal(info, values, grating))
            json.fail(refused->key, refused->found, refused->expected, refused->remedy);
        quality = pinned_quality(info, values, grating);
    }
    read_key_lights(json, info, quality);
    // Maps shade directional lights one by one even where they hold the key lights.
    if (quality.key_lights > 0 || info.is_map || json.is_recording_schema())
        quality.lights_at_vertices = at_vertices(json, "lights_at");
    if (info.is_map) quality.map_at_vertices = at_vertices(json, "map_at");
    return quality;
}

BudgetRecord::OfProbe parse_probe(JsonReader& json) {
    BudgetRecord::OfProbe probe;
    probe.probe = json.text("probe");
    probe.key_lights = static_cast<int>(json.integer("key_lights", 0, lighting::kMaximumKeyLights));
    probe.error = json.number("error", kNonNegative);
    json.finish();
    return probe;
}

std::string title_of(const std::string& text) {
    return fmt::format("method \"{}\"", text);
}

[[noreturn]] void refuse_method(const std::string& text, std::string found, std::string expected) {
    refuse_input(title_of(text), "", std::move(found), std::move(expected),
                 "for example arc/bands=5/rank=8/key_lights=16");
}

/// A whole number if it reads as one, else text.
nlohmann::json value_of(std::string_view text) {
    int number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure == std::errc() && end == text.data() + text.size()) return number;
    return std::string(text);
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
        end = text.find(separator, begin);
        parts.push_back(text.substr(begin, end == std::string::npos ? end : end - begin));
    }
    return parts;
}

int default_key_lights(const RepresentationInfo& info) {
    return info.key_lights == KeyLightUse::Always ? lighting::LightProbeSettings().key_lights : 0;
}

/// Reads "key_lights" and "window"; checks the other members, which become the method's quality.
Method read_method(const nlohmann::json& members, const std::string& file) {
    JsonReader reader(members, file);
    Method method{.quality = members};
    const int fallback = default_key_lights(read_settings(reader).info);
    method.key_lights = static_cast<int>(reader.integer_or("key_lights", fallback, 0, lighting::kMaximumKeyLights));
    method.window = math::parse_window(reader.choice_or("window", "none", {"none", "lanczos", "hann"}));
    method.quality.erase("key_lights");
    method.quality.erase("window");
    reader.finish();
    return method;
}

}  // namespace

ReadSettings read_settings(JsonReader& json) {
    const RepresentationInfo& info = *find_representation(json.choice("representation", representation_names()));
    return {info, SettingValues(info, json)};
}

std::variant<Quality, Refusal> suited_quality(const nlohmann::json& settings, const Grating& grating) {
    if (auto refused = baked_refusal(grating)) return *std::move(refused);
    JsonReader json(settings, "settings");
    const ReadSettings read = read_settings(json);
    if (auto refused = refusal(read.info, read.values, grating)) return *std::move(refused);
    Quality quality = pinned_quality(read.info, read.values, grating);
    read_key_lights(json, read.info, quality);
    json.finish();
    return quality;
}

Quality parse_quality(JsonReader json, const Grating& grating, const ReadNamed& read) {
    Quality quality;
    colour::Illuminant illuminant = parse_illuminant(json, read);
    const auto read_pinned = [&](JsonReader& pinned) {
        pinned.variant("representation", representation_names(), [&](JsonReader& reader, std::size_t index) {
            quality = parse_pinned(reader, *representations()[index], grating);
        });
    };
    json.alternatives("representation", read_pinned, [&](JsonReader& budget) { parse_measure(budget, quality); });
    quality.max_error = json.number_or("max_error", quality.max_error, kPositive);
    quality.illuminant = std::move(illuminant);
    json.finish();
    return quality;
}

double BudgetRecord::largest_error() const {
    double largest = 0.0;
    for (const OfProbe& probe : probes) largest = std::max(largest, probe.error);
    return largest;
}

const char* surface_shape_name(SurfaceShape surface) {
    return surface == SurfaceShape::Flat ? "flat" : "curved";
}

const char* error_measure_name(ErrorMeasure measure) {
    return kMeasureNames[static_cast<std::size_t>(measure)];
}

double default_max_error(ErrorMeasure measure) {
    return measure == ErrorMeasure::DeltaE ? kDefaultDeltaE : Quality().max_error;
}

ErrorMeasure read_error_measure(JsonReader& json) {
    const std::string name = json.choice_or("measure", kMeasureNames[0], {kMeasureNames.begin(), kMeasureNames.end()});
    return static_cast<ErrorMeasure>(std::ranges::find(kMeasureNames, name) - kMeasureNames.begin());
}

std::string write_budget_record(const BudgetRecord& record) {
    nlohmann::json json = {{"max_error", record.max_error},
                           {"measure", error_measure_name(record.measure)},
                           {"surface", surface_shape_name(record.surface)},
                           {"frames", record.frames},
                           {"price", record.price},
                           {"probes", nlohmann::json::array()}};
    for (const BudgetRecord::OfProbe& probe : record.probes)
        json["probes"].push_back({{"probe", probe.probe}, {"key_lights", probe.key_lights}, {"error", probe.error}});
    return json.dump();
}

BudgetRecord parse_budget_record(std::string_view text, const std::string& file) {
    const nlohmann::json document = parse_json(text, file);
    JsonReader json(document, file);
    BudgetRecord record;
    record.max_error = json.number("max_error", kNonNegative);
    record.measure = read_error_measure(json);
    if (json.choice("surface", {"flat", "curved"}) == "curved") record.surface = SurfaceShape::Curved;
    record.frames = static_cast<int>(json.integer("frames", 0, std::numeric_limits<int>::max()));
    record.price = json.number("price", kNonNegative);
    for (JsonReader& probe : json.objects("probes")) record.probes.push_back(parse_probe(probe));
    json.finish();
    return record;
}

Method parse_method(const std::string& text) {
    const std::vector<std::string> parts = split(text, '/');
    nlohmann::json members{{"representation", parts[0]}};
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const std::size_t equals = parts[i].find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == parts[i].size())
            refuse_method(text, fmt::format("\"{}\"", parts[i]), "name=value");
        const std::string key = parts[i].substr(0, equals);
        if (key == "representation") refuse_method(text, key, "the representation before the first slash");
        if (members.contains(key)) refuse_method(text, fmt::format("{} twice", key), "each setting once");
        members[key] = value_of(std::string_view(parts[i]).substr(equals + 1));
    }
    return read_method(members, title_of(text));
}

const RepresentationInfo& info(const Method& method) {
    return *find_representation(method.quality.at("representation").get<std::string>());
}

std::string method_name(const Method& method) {
    std::string name = info(method).name;
    const auto add = [&](const std::string& key, const std::string& value) {
        name += fmt::format("/{}={}", key, value);
    };
    for (const auto& [key, value] : method.quality.items())
        if (key != "representation") add(key, value.is_string() ? value.get<std::string>() : value.dump());
    if (method.key_lights != default_key_lights(info(method))) add("key_lights", std::to_string(method.key_lights));
    if (method.window != math::SphericalWindow::None) add("window", math::window_name(method.window));
    return name;
}

nlohmann::json to_json(const Method& method) {
    nlohmann::json json = method.quality;
    json["key_lights"] = method.key_lights;
    json["window"] = math::window_name(method.window);
    return json;
}

nlohmann::json with_method(nlohmann::json json, const Method& method) {
    nlohmann::json quality = method.quality;
    if (json.contains("quality") && json["quality"].is_object()) {
        const nlohmann::json& own = json["quality"];
        const bool same = own.value("representation", nlohmann::json()) == quality["representation"];
        for (const SettingInfo& setting : info(method).settings)
            if (same && own.contains(setting.key) && !quality.contains(setting.key))
                quality[setting.key] = own[setting.key];
        if (own.contains("illuminant")) quality["illuminant"] = own["illuminant"];
    }
    if (info(method).key_lights != KeyLightUse::Always) quality["key_lights"] = method.key_lights;
    json["quality"] = std::move(quality);
    return json;
}

std::optional<Refusal> refusal(const Method& method, const Grating& grating) {
    const auto quality = suited_quality(method.quality, grating);
    const auto* refused = std::get_if<Refusal>(&quality);
    return refused != nullptr ? std::optional(*refused) : std::nullopt;
}

}  // namespace rowland::diffraction
