#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace rowland::scene {

/// Component: what a scene's file says of a node beyond its place.
struct NodeLabel {
    std::string name;       ///< not always unique, or there
    nlohmann::json extras;  ///< as written; null: none
};

}  // namespace rowland::scene
