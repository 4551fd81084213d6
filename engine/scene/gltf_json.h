#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/json_reader.h"
#include "engine/core/json_vector.h"

namespace rowland::scene {

/// Adds `text` unless it is already there.
void warn_once(std::vector<std::string>& warnings, std::string text);

/// A glTF's JSON while it is read: objects name each other by an index into an array of the root. Everything that
/// throws throws Error (input) with the JSON pointer.
struct GltfJson {
    const nlohmann::json& root;
    const std::string& file;
    std::vector<std::string>& warnings;

    void warn(std::string text) const { warn_once(warnings, std::move(text)); }

    /// The objects of an array of the root; empty if it is missing.
    std::vector<JsonReader> objects(const std::string& array) const;

    /// The index under `key`, which must name an element of the root's `array`.
    std::size_t index(JsonReader& owner, const std::string& key, const std::string& array) const;
    std::optional<std::size_t> index_if_there(JsonReader& owner, const std::string& key,
                                              const std::string& array) const;
    /// An array of indices; empty if it is missing.
    std::vector<std::size_t> indices_if_there(JsonReader& owner, const std::string& key,
                                              const std::string& array) const;

 private:
    std::size_t size_of(const std::string& array) const;
};

/// The index under `key`, below `count`, which is the number of `things` in the file.
std::size_t read_index(JsonReader& owner, const std::string& key, std::size_t count, const std::string& things);

/// The object of the extension `name` of `owner`.
std::optional<JsonReader> extension_of(JsonReader& owner, const std::string& name);

}  // namespace rowland::scene
