#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rowland::test {

/// A JSON file of the source tree.
nlohmann::json read_source(const std::string& path);

/// What a schema cannot say, because it compares two members; the parser alone refuses it.
using SchemaException = std::function<bool(const nlohmann::json& document)>;

/// Expects that a schema allows what the parser takes: these documents, and of all that differ from one in a member,
/// which is removed, added or replaced, the same ones.
void expect_agreement(const nlohmann::json& schema, const std::vector<nlohmann::json>& documents,
                      const std::function<void(const nlohmann::json&)>& parse,
                      const SchemaException& beyond_the_schema);

}  // namespace rowland::test
