// The JSON Schemas beside the parsers say what the parsers do: thousands of small changes to good documents, each
// judged by both.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/lighting/probe_recipe.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/diffraction/asset/material_json.h"
#include "tests/support/json_schema.h"

namespace rowland {
namespace {

using nlohmann::json;

json read(const std::string& path) {
    const std::filesystem::path full = std::filesystem::path(ROWLAND_SOURCE_DIR) / path;
    return parse_json(read_text_file(full, 1 << 20), full.string());
}

/// Every document that differs from `document` in one place: a member gone, an unknown one added, a value replaced.
std::vector<json> neighbours(const json& document) {
    static const std::vector<json> replacements = {
        nullptr, true, "", "x", "flat", "all", json::array(), json::object(), -1, 0, 1, 2, 3.5, 64, 1e4, 1e12, -1e12};
    std::vector<json> result;
    const json leaves = document.flatten();
    for (const auto& [pointer, value] : leaves.items()) {
        for (json::json_pointer place(pointer); !place.empty(); place = place.parent_pointer()) {
            const auto with = [&](const std::function<void(json&)>& change) {
                json copy = document;
                change(copy);
                result.push_back(std::move(copy));
            };
            for (const json& replacement : replacements) with([&](json& copy) { copy[place] = replacement; });
            if (document[place.parent_pointer()].is_object()) {
                with([&](json& copy) { copy[place.parent_pointer()].erase(place.back()); });
                with([&](json& copy) { copy[place.parent_pointer()]["unknown"] = 1; });
            }
        }
    }
    return result;
}

/// What a schema cannot say, because it compares two members; the parser alone refuses it.
using Exception = std::function<bool(const json& document)>;

void expect_agreement(const json& schema, const std::vector<json>& documents,
                      const std::function<void(const json&)>& parse, const Exception& beyond_the_schema) {
    std::size_t accepted = 0;
    std::size_t refused = 0;
    for (const json& document : documents) {
        ASSERT_TRUE(test::satisfies(document, schema)) << document;
        ASSERT_NO_THROW(parse(document)) << document;
        for (const json& changed : neighbours(document)) {
            bool parsed = true;
            try {
                parse(changed);
            } catch (const Error&) {
                parsed = false;
            }
            const bool allowed = test::satisfies(changed, schema);
            const bool excused = allowed && !parsed && beyond_the_schema(changed);
            EXPECT_TRUE(parsed == allowed || excused) << (parsed ? "only parsed: " : "only allowed: ") << changed;
            (parsed ? accepted : refused) += 1;
        }
    }
    EXPECT_GT(accepted, 20U);
    EXPECT_GT(refused, 100U);
}

TEST(Schema, OfMaterialsAgreesWithTheParser) {
    const auto material = [](const std::string& profile, const std::string& rest) {
        return json::parse(R"({"grating": {"pitch_nm": 1600, "grooves": 900, "orders": [-1, 2], "profile": )" +
                           profile + rest);
    };
    const std::vector<json> documents = {
        read("content/materials/cd.json"), read("content/materials/cd_paper.json"),
        material(R"({"type": "lamellar", "duty": 0.4, "depth_nm": 100})", R"(, "groove_lobe": {"sigma": 0.2}}})"),
        material(R"({"type": "blazed", "depth_nm": 100}})", R"(, "metal": "Au", "quality": {"max_error": 0.1}})"),
        material(R"({"type": "slit", "width_nm": 0.5}, "normalization": "agu", "orders": "all"}})", "")};
    const auto crosses = [](const json& document) {
        const json& grating = document["grating"];
        const json& profile = grating["profile"];
        const bool wide = profile["type"] == "slit" && profile["width_nm"] > grating["pitch_nm"];
        const bool agu = grating.value("normalization", "energy") == "agu" && profile["type"] != "slit";
        return wide || agu;
    };
    expect_agreement(
        read("modules/diffraction/asset/material.schema.json"), documents,
        [](const json& document) { diffraction::parse_material(document, "test"); }, crosses);
}

TEST(Schema, OfProbeRecipesAgreesWithTheParser) {
    const std::vector<json> documents = {
        read("content/probes/studio.json"), read("content/probes/clear_sky.json"),
        json::parse(
            R"({"probe": {"type": "image", "file": "a.hdr", "mapping": "angular", "bands": 8, "face_size": 64}})"),
        json::parse(R"({"probe": {"type": "clear_sky", "sun_azimuth_deg": 3, "sun_elevation_deg": 4, "width": 256}})")};
    expect_agreement(
        read("engine/lighting/probe_recipe.schema.json"), documents,
        [](const json& document) { lighting::parse_probe_recipe(document, "test"); },
        [](const json&) { return false; });
}

TEST(Schema, OfMeshRecipesAgreesWithTheParser) {
    const std::vector<json> documents = {read("content/meshes/cd.json"), read("content/meshes/sphere.json"),
                                         read("content/meshes/ground.json")};
    const auto crosses = [](const json& document) {
        const json& mesh = document["mesh"];
        return mesh["type"] == "disc" && mesh["outer_radius"] <= mesh["inner_radius"];
    };
    expect_agreement(
        read("engine/scene/mesh_recipe.schema.json"), documents,
        [](const json& document) { scene::parse_mesh_recipe(document, "test"); }, crosses);
}

}  // namespace
}  // namespace rowland
