#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace rowland::inspector {

/// JSON whose members keep the order of the file.
using Json = nlohmann::ordered_json;

/// Parses untrusted text. Throws Error (input) as parse_json() does.
Json parse_ordered(std::string_view text, const std::string& file);

/// The text in the style of content/materials: indented by two spaces, one line per member of the outermost object;
/// arrays and inner objects on one line if that is at most 100 columns wide. Ends with a line break.
std::string format_json(const Json& value);

}  // namespace rowland::inspector
