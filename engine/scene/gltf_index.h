#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/json_reader.h"

namespace rowland::scene {

// How every part of the glTF's JSON names another: by an index into an array at the root.

/// The objects of the array `array` of the root; none if it is not there. Throws Error (input) if it is something else.
std::vector<JsonReader> root_objects(const nlohmann::json& root, const std::string& file, const std::string& array);

/// The index under `key`, required to name an element of the root's `array`. Throws Error (input).
std::size_t index_into(const nlohmann::json& root, JsonReader& reader, const std::string& key,
                       const std::string& array);
std::optional<std::size_t> index_if_there(const nlohmann::json& root, JsonReader& reader, const std::string& key,
                                          const std::string& array);
/// The same for an array of indices; none if it is not there.
std::vector<std::size_t> indices_if_there(const nlohmann::json& root, JsonReader& reader, const std::string& key,
                                          const std::string& array);

/// The text under `key`; empty if it is not there. Throws Error (input) if it is something else.
std::string text_if_there(JsonReader& reader, const std::string& key);

}  // namespace rowland::scene
