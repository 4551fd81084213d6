#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace rowland::scene {

/// Component: the name and the extras of a node in a scene file.
struct NodeLabel {
    std::string name;       ///< not always unique; may be empty
    nlohmann::json extras;  ///< as written; null: none
};

/// Whether extras say `"key": true`.
inline bool is_marked(const nlohmann::json& extras, const char* key) {
    return extras.is_object() && extras.contains(key) && extras[key] == true;
}

}  // namespace rowland::scene
