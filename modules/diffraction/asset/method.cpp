#include "modules/diffraction/asset/method.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_probe.h"
#include "modules/diffraction/asset/quality_json.h"

namespace rowland::diffraction {

namespace {

std::string title_of(const std::string& text) {
    return fmt::format("method \"{}\"", text);
}

[[noreturn]] void refuse(const std::string& text, std::string found, std::string expected) {
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

/// Reads "key_lights" and "window"; checks the other members, which are the quality.
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

Method parse_method(const std::string& text) {
    const std::vector<std::string> parts = split(text, '/');
    nlohmann::json members{{"representation", parts[0]}};
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const std::size_t equals = parts[i].find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == parts[i].size())
            refuse(text, fmt::format("\"{}\"", parts[i]), "name=value");
        const std::string key = parts[i].substr(0, equals);
        if (key == "representation") refuse(text, key, "the representation before the first slash");
        if (members.contains(key)) refuse(text, fmt::format("{} twice", key), "each setting once");
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

Method method_from_json(const nlohmann::json& json, const std::string& file) {
    return read_method(json, file);
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

void check_method(const nlohmann::json& json, const std::string& file, const Method& method) {
    require_baked_grooves(parse_material(with_method(json, method), file).grating, file);
}

CookedMaterial cook(const nlohmann::json& json, const std::string& file, const Method& method) {
    return cook_material(with_method(json, method), file);
}

}  // namespace rowland::diffraction
