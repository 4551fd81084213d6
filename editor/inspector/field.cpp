#include "editor/inspector/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/json_reader.h"

namespace rowland::inspector {

namespace {

constexpr std::size_t kColumns = 100;

/// The value on one line: `{ "a": 1 }`, `[1, 2]`.
std::string on_one_line(const Json& value) {
    if (!value.is_structured() || value.empty()) return value.dump();
    std::string text = value.is_object() ? "{ " : "[";
    bool first = true;
    for (const auto& [key, member] : value.items()) {
        if (!first) text += ", ";
        if (value.is_object()) text += Json(key).dump() + ": ";
        text += on_one_line(member);
        first = false;
    }
    return text + (value.is_object() ? " }" : "]");
}

/// `used`: the columns before the value, and one for the comma after it.
void write_json(const Json& value, std::size_t level, std::size_t used, std::string& text) {
    const std::string line = on_one_line(value);
    if (!value.is_structured() || value.empty() || (level > 0 && used + line.size() <= kColumns)) {
        text += line;
        return;
    }
    const std::string indent(2 * (level + 1), ' ');
    text += value.is_object() ? "{" : "[";
    bool first = true;
    for (const auto& [key, member] : value.items()) {
        if (!first) text += ",";
        text += '\n';
        text += indent;
        const std::string name = value.is_object() ? Json(key).dump() + ": " : "";
        text += name;
        write_json(member, level + 1, indent.size() + name.size() + 1, text);
        first = false;
    }
    text += '\n';
    text.append(2 * level, ' ');
    text += value.is_object() ? '}' : ']';
}

/// Members in the order of files. Others go to the end of their object.
constexpr std::array kFileOrder = {"grating",
                                   "pitch_nm",
                                   "grooves",
                                   "profile",
                                   "theory",
                                   "films",
                                   "orders",
                                   "normalization",
                                   "groove_lobe",
                                   "film",
                                   "metal",
                                   "cover",
                                   "transmission",
                                   "ior",
                                   "thickness_nm",
                                   "tint",
                                   "base",
                                   "color",
                                   "roughness",
                                   "quality",
                                   "grooveRotation",
                                   "grooveTexture",
                                   "iridescenceFactor",
                                   "iridescenceTexture",
                                   "iridescenceIor",
                                   "iridescenceThicknessMinimum",
                                   "iridescenceThicknessMaximum",
                                   "iridescenceThicknessTexture",
                                   "extras"};

auto position_in_file(const std::string& key) {
    return std::find(kFileOrder.begin(), kFileOrder.end(), key) - kFileOrder.begin();
}

/// Adds a member before the first that follows it in files.
void insert(Json& object, const std::string& key, const Json& value) {
    auto& members = object.get_ref<Json::object_t&>();
    const auto next = std::find_if(members.begin(), members.end(), [&](const auto& member) {
        return position_in_file(member.first) > position_in_file(key);
    });
    Json::object_t result(members.begin(), next);
    result.push_back({key, value});
    for (auto later = next; later != members.end(); ++later) result.push_back(*later);
    members = std::move(result);
}

const Json* find(const Json& material, const std::string& pointer) {
    const Json::json_pointer at(pointer);
    return material.contains(at) ? &material.at(at) : nullptr;
}

bool is_choice(const Json& value, const Choice& choice, const std::string& discriminator) {
    if (value.is_array() && choice.value.is_array() && !choice.value.empty() && choice.value[0].is_object())
        return value.size() == choice.value.size();
    if (!value.is_object() || !choice.value.is_object()) return discriminator.empty() && value == choice.value;
    if (!discriminator.empty()) return value.value(discriminator, Json()) == choice.value.value(discriminator, Json());
    return std::all_of(choice.value.items().begin(), choice.value.items().end(),
                       [&](const auto& member) { return value.contains(member.key()); });
}

/// The value of the choice `to`. Members that `from` also has keep their values.
Json carried_over(const Json& from, const Choice& to, const std::string& discriminator) {
    Json result = to.value;
    // Of the layers of a film the first ones stay; several are a list, a single one is an object.
    const auto is_list = [](const Json& value) { return value.is_array() && !value.empty() && value[0].is_object(); };
    if (is_list(from) && result.is_object()) return from[0];
    if (is_list(result)) {
        if (from.is_object()) result[0] = from;
        for (std::size_t i = 0; is_list(from) && i < std::min(from.size(), result.size()); ++i) result[i] = from[i];
        return result;
    }
    if (!from.is_object() || !result.is_object()) return result;
    for (const auto& [key, member] : from.items())
        if (key != discriminator && result.contains(key)) result[key] = member;
    return result;
}

/// A whole number loses its fraction: 5.0 is written as 5.
Json plain(const Json& value) {
    constexpr double kExact = 9e15;  // up to here every double with a zero fraction converts exactly
    if (value.is_array()) {
        Json parts = Json::array();
        for (const Json& part : value) parts.push_back(plain(part));
        return parts;
    }
    if (!value.is_number_float()) return value;
    const double number = value.get<double>();
    if (number != std::floor(number) || std::abs(number) > kExact) return value;
    return static_cast<std::int64_t>(number);
}

}  // namespace

Json parse_ordered(std::string_view text, const std::string& file) {
    parse_json(text, file);  // throws an Error with line and column
    return Json::parse(text);
}

std::string format_json(const Json& value) {
    std::string text;
    write_json(value, 0, 0, text);
    return text + "\n";
}

bool holds_film(const Json& material) {
    return !material.is_null() && !material.contains("grating");
}

std::vector<std::span<const Field>> fields_of(const Json& material) {
    if (!holds_film(material)) return {groove_fields(), fields()};
    return {material.contains("film") ? film_fields() : iridescence_fields()};
}

const Field& field_at(std::string_view pointer) {
    for (const auto all : {fields(), groove_fields(), film_fields(), iridescence_fields()}) {
        const auto found = std::ranges::find(all, pointer, &Field::pointer);
        if (found != all.end()) return *found;
    }
    check_failed(__FILE__, __LINE__, fmt::format("no field at {}", pointer));
}

bool is_shown(const Field& field, const Json& material) {
    if (field.only_with.empty()) return true;
    const Field* other = shown_field(field.only_with, material);
    return other != nullptr && std::ranges::count(field.only_for, choice_of(*other, material)) > 0;
}

const Field* shown_field(std::string_view pointer, const Json& material) {
    for (const auto all : fields_of(material))
        for (const Field& field : all)
            if (field.pointer == pointer && is_shown(field, material)) return &field;
    return nullptr;
}

const Field* field_of_refusal(std::string_view pointer, const Json& material) {
    for (;;) {
        if (const Field* field = shown_field(pointer, material)) return field;
        const std::size_t end = pointer.rfind('/');
        if (end == std::string_view::npos) return nullptr;
        pointer = pointer.substr(0, end);
    }
}

Json value_of(const Field& field, const Json& material) {
    if (const Json* found = find(material, field.pointer)) return *found;
    if (field.defaults_by_choice.empty()) return field.default_value;
    const std::string present = choice_of(field_at(field.only_with), material);
    for (const Choice& choice : field.defaults_by_choice)
        if (choice.name == present) return choice.value;
    return field.default_value;
}

bool can_revert(const Field& field, const Json& material) {
    const Json* found = find(material, field.pointer);
    if (field.required && field.default_value.is_null()) return false;
    return field.required ? found == nullptr || *found != field.default_value : found != nullptr;
}

std::string choice_of(const Field& field, const Json& material) {
    const Json value = value_of(field, material);
    for (const Choice& choice : field.choices)
        if (is_choice(value, choice, field.discriminator)) return choice.name;
    return {};
}

Json with_value(const Json& material, const Field& field, const Json& value) {
    Json result = material;
    Json* at = &result;
    std::string_view path = field.pointer;
    for (;;) {
        path.remove_prefix(1);
        const std::size_t end = std::min(path.find('/'), path.size());
        const std::string key(path.substr(0, end));
        path.remove_prefix(end);
        if (at->is_array()) {
            at = &at->at(std::stoul(key));
            continue;
        }
        if (!at->is_object()) *at = Json::object();
        if (path.empty() && value.is_null()) {
            at->erase(key);
            return result;
        }
        if (!at->contains(key)) {
            if (value.is_null()) return result;
            insert(*at, key, Json::object());
        }
        at = &(*at)[key];
        if (path.empty()) break;
    }
    *at = plain(value);
    return result;
}

namespace {

/// The material after an edit of `field`, with the field's alternative removed or set.
Json with_alternative(const Json& material, const Field& field) {
    if (field.alternative.empty()) return material;
    const Field other{.pointer = field.alternative, .label = {}};
    if (find(material, field.pointer) != nullptr) return with_value(material, other, nullptr);
    return field.alternative_value.is_null() ? material : with_value(material, other, field.alternative_value);
}

}  // namespace

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
    // No profile suits both grooves and lattices, so another pattern replaces the whole grating.
    Json value = field.pointer == "/grating" ? found->value
                                             : carried_over(value_of(field, material), *found, field.discriminator);
    // The illuminant does not depend on the choice.
    const Json* illuminant = find(material, "/quality/illuminant");
    if (field.pointer == "/quality" && illuminant != nullptr) value["illuminant"] = *illuminant;
    return with_alternative(with_value(material, field, value), field);
}

Json reverted(const Json& material, const Field& field) {
    return with_alternative(with_value(material, field, field.required ? field.default_value : Json()), field);
}

double number_of(const Json& value) {
    return value.is_number() ? value.get<double>() : 0.0;
}

double rounded(double value) {
    return std::round(value * 1e3) / 1e3;
}

double shown_number(const Field& field, double stored) {
    return field.unit == "rad" ? stored * 180.0 / std::numbers::pi : stored;
}

double stored_number(const Field& field, double shown) {
    return field.unit == "rad" ? shown * std::numbers::pi / 180.0 : shown;
}

std::string shown_unit(const Field& field) {
    return field.unit == "rad" ? "°" : field.unit;
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
