#include "editor/trade/setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/lighting/key_lights.h"

namespace rowland::trade {

namespace {

[[noreturn]] void refuse(const std::string& text, std::string found, std::string expected) {
    throw Error({.file = fmt::format("setting \"{}\"", text),
                 .place = {},
                 .found = std::move(found),
                 .expected = std::move(expected),
                 .remedy = "for example arc/bands=5/rank=8/key_lights=16"});
}

/// A whole number if it reads as one, else text.
nlohmann::json value_of(std::string_view text) {
    int number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure == std::errc() && end == text.data() + text.size()) return number;
    return std::string(text);
}

math::SphericalWindow window_of(const std::string& whole, const std::string& name) {
    for (const auto window : {math::SphericalWindow::None, math::SphericalWindow::Lanczos, math::SphericalWindow::Hann})
        if (name == math::window_name(window)) return window;
    refuse(whole, fmt::format("window \"{}\"", name), "none, lanczos or hann");
}

int key_lights_of(const std::string& whole, const nlohmann::json& value) {
    if (!value.is_number_integer() || value < 0 || value > lighting::kMaximumKeyLights)
        refuse(whole, fmt::format("key_lights {}", value.dump()),
               fmt::format("a whole number from 0 to {}", lighting::kMaximumKeyLights));
    return value.get<int>();
}

void set(const std::string& whole, const std::string& key, const nlohmann::json& value, Setting& setting) {
    if (key == "key_lights") {
        setting.key_lights = key_lights_of(whole, value);
    } else if (key == "window") {
        setting.window = window_of(whole, value.is_string() ? value.get<std::string>() : value.dump());
    } else {
        setting.quality[key] = value;
    }
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

/// Representations that take all light as SH unless their material says otherwise.
bool takes_all_light_as_sh(const std::string& representation) {
    constexpr std::array kNames = {"spikes", "bins", "transfer", "arc"};
    return std::find(kNames.begin(), kNames.end(), representation) != kNames.end();
}

/// The material with the setting in place of its "quality", but for the illuminant.
nlohmann::json with_setting(nlohmann::json json, const Setting& setting) {
    nlohmann::json quality = setting.quality;
    if (takes_all_light_as_sh(setting.quality.value("representation", "")))
        quality["key_lights"] = setting.key_lights > 0;
    if (json.contains("quality") && json["quality"].contains("illuminant"))
        quality["illuminant"] = json["quality"]["illuminant"];
    json["quality"] = std::move(quality);
    return json;
}

}  // namespace

Setting parse_setting(const std::string& text) {
    const std::size_t slash = text.find('/');
    Setting setting;
    setting.quality["representation"] = text.substr(0, slash);
    if (slash == std::string::npos) return setting;
    for (const std::string& part : split(text.substr(slash + 1), '/')) {
        const std::size_t equals = part.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == part.size())
            refuse(text, fmt::format("\"{}\"", part), "name=value");
        const std::string key = part.substr(0, equals);
        if (key == "representation" || key == "quality") refuse(text, key, "the representation before the first slash");
        set(text, key, value_of(std::string_view(part).substr(equals + 1)), setting);
    }
    return setting;
}

std::string representation_of(const Setting& setting) {
    return setting.quality.value("representation", "");
}

std::string setting_name(const Setting& setting) {
    std::string name = representation_of(setting);
    const auto add = [&](const std::string& key, const std::string& value) {
        name += fmt::format("/{}={}", key, value);
    };
    for (const auto& [key, value] : setting.quality.items())
        if (key != "representation") add(key, value.is_string() ? value.get<std::string>() : value.dump());
    if (setting.key_lights != 0) add("key_lights", std::to_string(setting.key_lights));
    if (setting.window != math::SphericalWindow::None) add("window", math::window_name(setting.window));
    return name;
}

nlohmann::json to_json(const Setting& setting) {
    return {{"quality", setting.quality},
            {"key_lights", setting.key_lights},
            {"window", math::window_name(setting.window)}};
}

Setting setting_from_json(const nlohmann::json& json, const std::string& file) {
    JsonReader reader(json, file);
    Setting setting;
    setting.key_lights = static_cast<int>(reader.integer("key_lights", 0, lighting::kMaximumKeyLights));
    setting.window = math::parse_window(reader.choice("window", {"none", "lanczos", "hann"}));
    JsonReader quality = reader.object("quality");
    quality.text("representation");
    setting.quality = reader.raw("quality");
    reader.finish();
    return setting;
}

void check(nlohmann::json json, const std::string& file, const Setting& setting) {
    const nlohmann::json whole = with_setting(std::move(json), setting);
    diffraction::require_baked_grooves(diffraction::parse_material(whole, file).grating, file);
}

diffraction::CookedMaterial cook(nlohmann::json json, const std::string& file, const Setting& setting) {
    return diffraction::cook_material(with_setting(std::move(json), setting), file);
}

}  // namespace rowland::trade
