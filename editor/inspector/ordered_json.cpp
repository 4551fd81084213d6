#include "editor/inspector/ordered_json.h"

#include <cstddef>

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
void write(const Json& value, std::size_t level, std::size_t used, std::string& text) {
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
        write(member, level + 1, indent.size() + name.size() + 1, text);
        first = false;
    }
    text += '\n';
    text.append(2 * level, ' ');
    text += value.is_object() ? '}' : ']';
}

}  // namespace

Json parse_ordered(std::string_view text, const std::string& file) {
    parse_json(text, file);  // throws an Error with line and column
    return Json::parse(text);
}

std::string format_json(const Json& value) {
    std::string text;
    write(value, 0, 0, text);
    return text + "\n";
}

}  // namespace rowland::inspector
