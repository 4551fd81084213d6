#include "engine/colour/colour_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace rowland::colour {

Metal read_metal(JsonReader& json) {
    const std::vector<std::string> names = metal_names();
    return parse_metal(json.choice("metal", {names.begin(), names.end()})).value();
}

Illuminant read_builtin_illuminant(JsonReader& json) {
    const std::vector<std::string> names = illuminant_names();
    return illuminant(json.choice_or("illuminant", d65().name, {names.begin(), names.end()}));
}

std::variant<Illuminant, std::string> read_illuminant(JsonReader& json, const std::string& owner) {
    const std::string name = json.text_or("illuminant", d65().name);
    const std::vector<std::string> names = illuminant_names();
    if (std::find(names.begin(), names.end(), name) != names.end()) return illuminant(name);
    if (name.ends_with(".csv")) return name;
    const auto near = nearest_word(name, names);
    json.fail("illuminant", fmt::format("\"{}\"", name),
              fmt::format("one of {}, or a .csv file beside {}", fmt::join(names, ", "), owner),
              near ? fmt::format("is \"{}\" meant?", *near) : "");
}

}  // namespace rowland::colour
