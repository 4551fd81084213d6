#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace rowland::inspector {

/// JSON whose members keep the order of the file.
using Json = nlohmann::ordered_json;

/// Parses text that may be hostile. Throws Error (input) as parse_json() does.
Json parse_ordered(std::string_view text, const std::string& file);

/// Text as this tree's material files are written: two spaces a level, the outermost object a member a line, an array
/// or an inner object on one line if that stays within 100 columns. Ends with a line break.
std::string format_json(const Json& value);

}  // namespace rowland::inspector
