#pragma once

#include <nlohmann/json.hpp>

namespace rowland::test {

/// Whether `value` satisfies a JSON Schema written with: type, const, enum, minimum, maximum, exclusiveMinimum,
/// exclusiveMaximum, multipleOf, minLength, required, properties, additionalProperties: false, items, minItems,
/// maxItems, uniqueItems, oneOf, and $ref into $defs. Throws std::runtime_error for any other keyword, so that a schema
/// cannot ask for what is not checked.
bool satisfies(const nlohmann::json& value, const nlohmann::json& schema);

}  // namespace rowland::test
