#include "tests/unit/schema_agreement.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "tests/support/json_schema.h"
#include "tests/support/source_tree.h"

namespace rowland::test {

using nlohmann::json;

namespace {

/// Every document that differs from `document` in one member, which is removed, added or replaced.
std::vector<json> neighbours(const json& document) {
    static const std::vector<json> replacements = {
        nullptr, true, "", "x", "flat", "all", json::array(), json::object(), -1, 0, 1, 2, 3.5, 64, 1e4, 1e12, -1e12};
    std::vector<json> result;
    const json leaves = document.flatten();
    for (const auto& [pointer, value] : leaves.items()) {
        for (json::json_pointer location(pointer); !location.empty(); location = location.parent_pointer()) {
            const auto with = [&](const std::function<void(json&)>& change) {
                json copy = document;
                change(copy);
                result.push_back(std::move(copy));
            };
            for (const json& replacement : replacements) with([&](json& copy) { copy[location] = replacement; });
            if (document[location.parent_pointer()].is_object()) {
                with([&](json& copy) { copy[location.parent_pointer()].erase(location.back()); });
                with([&](json& copy) { copy[location.parent_pointer()]["unknown"] = 1; });
            }
        }
    }
    return result;
}

}  // namespace

json read_source(const std::string& path) {
    const std::filesystem::path full = source_path(path);
    return parse_json(read_text_file(full, 1 << 20), full.string());
}

void expect_agreement(const json& schema, const std::vector<json>& documents,
                      const std::function<void(const json&)>& parse, const SchemaException& beyond_the_schema) {
    std::size_t accepted = 0;
    std::size_t refused = 0;
    for (const json& document : documents) {
        ASSERT_TRUE(satisfies(document, schema)) << document;
        ASSERT_NO_THROW(parse(document)) << document;
        for (const json& changed : neighbours(document)) {
            bool parsed = true;
            try {
                parse(changed);
            } catch (const Error&) {
                parsed = false;
            }
            const bool allowed = satisfies(changed, schema);
            const bool excused = allowed && !parsed && beyond_the_schema(changed);
            EXPECT_TRUE(parsed == allowed || excused) << (parsed ? "only parsed: " : "only allowed: ") << changed;
            (parsed ? accepted : refused) += 1;
        }
    }
    EXPECT_GT(accepted, 20U);
    EXPECT_GT(refused, 100U);
}

}  // namespace rowland::test
