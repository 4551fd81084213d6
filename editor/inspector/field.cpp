#include "editor/inspector/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "engine/core/check.h"

namespace rowland::inspector {

namespace {

/// The members of a material file in the order they are usually written.
constexpr std::array kUsualOrder = {
    "grating",        "pitch_nm",       "grooves", "profile",       "type",        "width_nm",  "duty",
    "depth_nm",       "file",           "orders",  "normalization", "groove_lobe", "sigma",     "pits",
    "length_nm",      "coherent",       "metal",   "base",          "color",       "roughness", "quality",
    "representation", "max_error",      "probes",  "surface",       "bands",       "rank",      "spikes",
    "bins",           "map_resolution", "nodes",   "taps",          "key_lights",  "lights_at", "illuminant"};

std::size_t place_of(const std::string& key) {
    return static_cast<std::size_t>(std::find(kUsualOrder.begin(), kUsualOrder.end(), key) - kUsualOrder.begin());
}

/// Adds a member before the first that usually comes after it.
void insert(Json& object, const std::string& key, const Json& value) {
    Json result = Json::object();
    bool inserted = false;
    for (const auto& [name, member] : object.items()) {
        if (!inserted && place_of(name) > place_of(key)) {
            result[key] = value;
            inserted = true;
        }
        result[name] = member;
    }
    if (!inserted) result[key] = value;
    object = std::move(result);
}

std::vector<std::string> steps(std::string_view pointer) {
    std::vector<std::string> result;
    while (!pointer.empty()) {
        pointer.remove_prefix(1);
        const std::size_t end = std::min(pointer.find('/'), pointer.size());
        result.emplace_back(pointer.substr(0, end));
        pointer.remove_prefix(end);
    }
    return result;
}

const Json* find(const Json& material, std::string_view pointer) {
    const Json* at = &material;
    for (const std::string& step : steps(pointer)) {
        if (!at->is_object() || !at->contains(step)) return nullptr;
        at = &(*at)[step];
    }
    return at;
}

bool is_choice(const Json& value, const Choice& choice, const std::string& told_by) {
    if (!told_by.empty()) {
        const auto tell = [&](const Json& json) {
            return json.is_object() && json.contains(told_by) ? json[told_by] : Json();
        };
        return tell(value) == tell(choice.value);
    }
    if (!value.is_object() || !choice.value.is_object()) return value == choice.value;
    return std::all_of(choice.value.items().begin(), choice.value.items().end(),
                       [&](const auto& member) { return value.contains(member.key()); });
}

/// What another choice may keep: the members that mean the same there.
Json carried_over(const Json& from, const Choice& to, const std::string& told_by) {
    Json result = to.value;
    if (!from.is_object() || !result.is_object()) return result;
    for (const auto& [key, member] : from.items())
        if (key != told_by && result.contains(key)) result[key] = member;
    return result;
}

/// Whole numbers are written without a fraction.
Json plain(const Json& value) {
    constexpr double kExact = 9e15;  // whole doubles below are whole numbers
    if (!value.is_number_float()) return value;
    const double number = value.get<double>();
    if (number != std::floor(number) || std::abs(number) > kExact) return value;
    return static_cast<std::int64_t>(number);
}

}  // namespace

const Field& field_at(std::string_view pointer) {
    const auto all = fields();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Field& field) { return field.pointer == pointer; });
    ROWLAND_CHECK(found != all.end(), fmt::format("no field at {}", pointer));
    return *found;
}

const Field* field_of_refusal(std::string_view place) {
    const Field* best = nullptr;
    for (const Field& field : fields()) {
        const std::string& pointer = field.pointer;
        const bool begins = place == pointer || (place.starts_with(pointer) && place[pointer.size()] == '/');
        if (begins && (best == nullptr || pointer.size() > best->pointer.size())) best = &field;
    }
    return best;
}

bool is_shown(const Field& field, const Json& material) {
    if (field.only_with.empty()) return true;
    const std::string present = choice_of(field_at(field.only_with), material);
    return std::find(field.only_for.begin(), field.only_for.end(), present) != field.only_for.end();
}

Json value_of(const Field& field, const Json& material) {
    const Json* found = find(material, field.pointer);
    return found != nullptr ? *found : field.usual;
}

bool can_revert(const Field& field, const Json& material) {
    const Json* found = find(material, field.pointer);
    return field.required ? found == nullptr || *found != field.usual : found != nullptr;
}

std::string choice_of(const Field& field, const Json& material) {
    const Json value = value_of(field, material);
    for (const Choice& choice : field.choices)
        if (is_choice(value, choice, field.told_by)) return choice.name;
    return {};
}

Json with_value(const Json& material, const Field& field, const Json& value) {
    Json result = material;
    Json* at = &result;
    const std::vector<std::string> path = steps(field.pointer);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        if (!at->is_object()) *at = Json::object();
        if (!at->contains(path[i])) {
            if (value.is_null()) return result;
            insert(*at, path[i], Json::object());
        }
        at = &(*at)[path[i]];
    }
    if (!at->is_object()) *at = Json::object();
    if (value.is_null())
        at->erase(path.back());
    else if (at->contains(path.back()))
        (*at)[path.back()] = plain(value);
    else
        insert(*at, path.back(), plain(value));
    return result;
}

Json with_pitch(const Json& material, double pitch_nm) {
    const Field& pitch = field_at("/grating/pitch_nm");
    const Field& width = field_at("/grating/profile/width_nm");
    Json result = with_value(material, pitch, pitch_nm);
    const Json* before = find(material, pitch.pointer);
    const Json* slit = find(material, width.pointer);
    if (before == nullptr || !before->is_number() || slit == nullptr || !slit->is_number()) return result;
    const double scaled = slit->get<double>() * pitch_nm / before->get<double>();
    if (!std::isfinite(scaled) || scaled <= 0.0) return result;
    return with_value(result, width, std::min(std::round(scaled * 1e3) / 1e3, pitch_nm));
}

Json with_choice(const Json& material, const Field& field, const std::string& name) {
    const auto found = std::find_if(field.choices.begin(), field.choices.end(),
                                    [&](const Choice& choice) { return choice.name == name; });
    ROWLAND_CHECK(found != field.choices.end(), fmt::format("{} has no choice {}", field.pointer, name));
    Json value = carried_over(value_of(field, material), *found, field.told_by);
    // Every quality knows its illuminant.
    const Json* illuminant = find(material, "/quality/illuminant");
    if (field.pointer == "/quality" && illuminant != nullptr) value["illuminant"] = *illuminant;
    return with_value(material, field, value);
}

Json reverted(const Json& material, const Field& field) {
    return with_value(material, field, field.required ? field.usual : Json());
}

Json parse_orders(std::string_view text) {
    Json orders = Json::array();
    const std::string_view separators = " ,;\t[]";
    std::size_t at = text.find_first_not_of(separators);
    while (at != std::string_view::npos) {
        const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
        std::string_view word = text.substr(at, end - at);
        if (word == "all") return "all";
        if (word.starts_with('+')) word.remove_prefix(1);
        int order = 0;
        const auto read = std::from_chars(word.data(), word.data() + word.size(), order);
        if (read.ec != std::errc() || read.ptr != word.data() + word.size()) return std::string(text);
        orders.push_back(order);
        at = text.find_first_not_of(separators, end);
    }
    return orders;
}

std::string format_orders(const Json& orders) {
    if (orders.is_string()) return orders.get<std::string>();
    if (!orders.is_array()) return orders.dump();
    std::string text;
    for (const Json& order : orders) {
        if (!text.empty()) text += ' ';
        text += order.dump();
    }
    return text;
}

double lines_per_mm(double pitch_nm) {
    return 1e6 / pitch_nm;
}

double pitch_of_lines(double per_mm) {
    return std::round(1e9 / per_mm) / 1e3;
}

}  // namespace rowland::inspector
