#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/core/json_reader.h"

namespace rowland {

/// The JSON Schema (draft 2020-12) of the objects that a parser reads: what it asks of its reader. It lacks only what
/// compares members with each other.
nlohmann::ordered_json json_schema(const std::string& title, const std::function<void(JsonReader&)>& parse);

}  // namespace rowland
