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
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material_json.h"
#include "tests/support/json_schema.h"
#include "tests/support/temporary_folder.h"

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

/// Whatever a material calls its table.
diffraction::NamedText read_one_table(const std::string& name) {
    return {.text = "wavelength_nm,R-1,R+1\n500,0.1,0.4\n", .file = name};
}

/// What a representation cannot do with a grating's lobe, or with others of its own settings.
bool crosses_quality(const json& document) {
    const json quality = document.value("quality", json::object());
    const bool flat = document["grating"].value("groove_lobe", json("flat")) == "flat";
    const std::string name = quality.value("representation", "spikes");
    const std::string usual = name == "arc" ? "one-dimensional" : "";
    const bool along_one_axis = quality.value("view_mapping", usual) == "one-dimensional";
    const bool view = flat ? name == "arc" && !along_one_axis : quality.contains("view_mapping") && along_one_axis;
    const bool map = !flat && (name == "planar" || name == "circle");
    const int bands = quality.value("bands", 5);
    const bool layers = quality.value("spikes", quality.value("bins", 1)) * (bands * bands + 4) / 4 > 2048;
    return view || map || layers;
}

/// What a material's members forbid each other.
bool crosses_members(const json& document) {
    const json& grating = document["grating"];
    const json& profile = grating["profile"];
    const json lobe = grating.value("groove_lobe", json("flat"));
    const bool wide = profile["type"] == "slit" && profile["width_nm"] > grating["pitch_nm"];
    const bool agu = grating.value("normalization", "energy") == "agu" && profile["type"] != "slit";
    const bool plated_table = profile["type"] == "table" && document.contains("metal");
    const bool few = grating.value("grooves", 1500.0) < 50.0 && (profile["type"] == "table" || lobe.contains("pits"));
    const bool endless = grating.value("orders", json()) == "all" && grating["pitch_nm"] > 190000.0;
    return wide || agu || plated_table || few || endless || crosses_quality(document);
}

/// A schema cannot know which files there are.
bool names_another_file(const json& document) {
    const json& profile = document["grating"]["profile"];
    return profile["type"] == "table" && profile["file"] != "t.csv";
}

TEST(Schema, OfMaterialsAgreesWithTheParser) {
    const auto material = [](const std::string& profile, const std::string& rest) {
        return json::parse(R"({"grating": {"pitch_nm": 1600, "grooves": 900, "orders": [-1, 2], "profile": )" +
                           profile + rest);
    };
    const auto pinned = [&](const std::string& quality) {
        return material(R"({"type": "slit", "width_nm": 800}}, "quality": )", quality + "}");
    };
    const std::vector<json> documents = {
        read("content/materials/cd.json"),
        read("content/materials/cd_paper.json"),
        material(R"({"type": "lamellar", "duty": 0.4, "depth_nm": 100})", R"(, "groove_lobe": {"sigma": 0.2}}})"),
        material(R"({"type": "blazed", "depth_nm": 100}})",
                 R"(, "metal": "Au", "quality": {"max_error": 0.1, "illuminant": "F11"}})"),
        material(R"({"type": "slit", "width_nm": 0.5}, "normalization": "agu", "orders": "all"}})", ""),
        material(R"({"type": "table", "file": "t.csv"}})", R"(, "base": {"roughness": 0.1}})"),
        material(R"({"type": "sinusoidal", "depth_nm": 90})",
                 R"(, "groove_lobe": {"pits": {"length_nm": 850, "coherent": 0.3}}}})"),
        pinned(R"({"representation": "spikes", "spikes": 8, "view_mapping": "parabolic", "key_lights": true})"),
        pinned(R"({"representation": "bins", "bins": 9, "bands": 4, "view_resolution": 20, "storage": "unorm8"})"),
        pinned(R"({"representation": "transfer", "bands": 3, "view_mapping": "spherical", "max_error": 0.2})"),
        pinned(
            R"({"representation": "arc", "bands": 6, "rank": 12, "storage": "fp32", "key_lights": false, "illuminant": "A"})"),
        pinned(R"({"representation": "direct", "key_lights": true})"),
        pinned(R"({"representation": "planar", "rank": 6, "map_resolution": 128})"),
        pinned(R"({"representation": "circle", "map_resolution": 32})")};
    expect_agreement(
        read("modules/diffraction/asset/material.schema.json"), documents,
        [](const json& document) { diffraction::parse_material(document, "test", read_one_table); }, crosses_members);
}

/// The extension is a definition of the material's schema, so that both share the grating's.
TEST(Schema, OfTheGltfExtensionAgreesWithTheParser) {
    const test::TemporaryFolder folder;
    write_file_atomic(folder.path() / "t.csv", read_one_table("t.csv").text);
    json schema = {{"$ref", "#/$defs/ROWLAND_materials_diffraction"}};
    schema["$defs"] = read("modules/diffraction/asset/material.schema.json")["$defs"];
    const std::vector<json> documents = {
        json::parse(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 600}},
                        "grooveRotation": 1.5, "grooveTexture": {"index": 2, "texCoord": 1}, "metal": "Cu"})"),
        json::parse(R"({"grating": {"pitch_nm": 740, "profile": {"type": "table", "file": "t.csv"}},
                        "grooveTexture": {"index": 0, "extras": {}}, "extras": [1], "extensions": {"X": 1}})")};
    expect_agreement(
        schema, documents,
        [&](const json& document) { diffraction::parse_gltf_extension(document, "test", folder.path()); },
        [](const json& document) { return crosses_members(document) || names_another_file(document); });
}

TEST(Schema, OfProbeRecipesAgreesWithTheParser) {
    const std::vector<json> documents = {
        read("content/probes/studio.json"),
        read("content/probes/clear_sky.json"),
        json::parse(
            R"({"probe": {"type": "image", "file": "a.hdr", "mapping": "angular", "bands": 8, "key_lights": 9, "face_size": 64}})"),
        json::parse(R"({"probe": {"type": "clear_sky", "sun_azimuth_deg": 3, "sun_elevation_deg": 4, "width": 256}})"),
        json::parse(R"({"probe": {"type": "image", "file": "a.hdr", "illuminant": "F11"}})"),
        json::parse(R"({"probe": {"type": "image", "file": "a.hdr", "illuminant": "lamps/sodium.csv"}})")};
    // Names that end in .csv are files; the others must be built in.
    const auto unknown_illuminant = [](const json& document) {
        const json& name = document["probe"].value("illuminant", json("D65"));
        return name.is_string() && !name.get<std::string>().ends_with(".csv");
    };
    expect_agreement(
        read("engine/lighting/probe_recipe.schema.json"), documents,
        [](const json& document) { lighting::parse_probe_recipe(document, "test"); }, unknown_illuminant);
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
