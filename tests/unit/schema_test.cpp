// The JSON Schemas beside the parsers say what the parsers do: thousands of small changes to good documents, each
// judged by both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/lighting/probe_recipe.h"
#include "engine/scene/mesh_recipe.h"
#include "engine/scene/scene_recipe.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/height_map_png.h"
#include "modules/diffraction/asset/material_json.h"
#include "modules/thin_film/asset/film_material.h"
#include "tests/support/json_schema.h"
#include "tests/support/source_tree.h"
#include "tests/support/temporary_folder.h"

namespace rowland {
namespace {

using nlohmann::json;

json read(const std::string& path) {
    const std::filesystem::path full = rowland::test::source_path(path);
    return parse_json(read_text_file(full, 1 << 20), full.string());
}

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

/// Whatever a material calls its table; its lamp is lamp.csv.
diffraction::NamedText read_one_table(const std::string& name) {
    if (name == "lamp.csv") return {.text = "wavelength_nm,relative_power\n500,1\n600,2\n", .file = name};
    if (name == "cell.png") {
        diffraction::HeightMap map{.columns = 16, .rows = 16, .heights = {}, .depth_nm = 0.0};
        map.heights.assign(256, 9);
        return {.text = diffraction::write_height_map(map), .file = name};
    }
    return {.text = "wavelength_nm,R-1,R+1\n500,0.1,0.4\n", .file = name};
}

/// What a representation cannot do with a grating's lobe, or with others of its own settings.
bool crosses_quality(const json& document) {
    const json quality = document.value("quality", json::object());
    const bool flat = document["grating"].value("groove_lobe", json("flat")) == "flat";
    const std::string name = quality.value("representation", "spikes");
    const std::string default_mapping = name == "arc" ? "one-dimensional" : "";
    const bool along_one_axis = quality.value("view_mapping", default_mapping) == "one-dimensional";
    const bool view = flat ? name == "arc" && !along_one_axis : quality.contains("view_mapping") && along_one_axis;
    const bool map = flat ? quality.contains("views_h")
                          : name == "circle" || (name == "planar" && quality.value("map_resolution", 128) > 256);
    const bool narrow = !flat && document["grating"]["groove_lobe"].value("/pits/coherent"_json_pointer, 1.0) > 0.0;
    const bool streak = name == "streak" && !narrow;
    const int bands = quality.value("bands", 5);
    const bool layers = quality.value("spikes", quality.value("bins", 1)) * (bands * bands + 4) / 4 > 2048;
    return view || map || layers || streak;
}

/// What a cell's sides forbid each other, its profile and its orders.
bool crosses_cell(const json& grating) {
    if (!grating.contains("lattice")) return false;
    const auto a = grating["lattice"]["a_nm"].get<std::vector<double>>();
    const auto b = grating["lattice"]["b_nm"].get<std::vector<double>>();
    const double length_a = std::hypot(a[0], a[1]);
    const double length_b = std::hypot(b[0], b[1]);
    const json& profile = grating["profile"];
    const bool short_or_long = std::min(length_a, length_b) < 300.0 || std::max(length_a, length_b) > 1e7;
    const bool flat = std::abs(a[0] * b[1] - a[1] * b[0]) < 0.0348995 * length_a * length_b;  // 2 degrees
    const bool wide =
        profile["type"] == "aperture" && (profile["width_nm"] > length_a || profile["height_nm"] > length_b);
    const bool picture =
        profile["type"] == "height_map" && (profile["file"] != "cell.png" || 2 * grating.value("orders", 2) >= 16);
    return short_or_long || flat || wide || picture;
}

/// What a material's members forbid each other.
bool crosses_members(const json& document) {
    const json& grating = document["grating"];
    if (crosses_cell(grating)) return true;
    const json& profile = grating["profile"];
    const json lobe = grating.value("groove_lobe", json("flat"));
    const bool wide = profile["type"] == "slit" && profile["width_nm"] > grating["pitch_nm"];
    const bool agu = grating.value("normalization", "energy") == "agu" && profile["type"] != "slit";
    const bool plated_table =
        profile["type"] == "table" && (document.contains("metal") || document.contains("/cover/tint"_json_pointer));
    const bool plated_sheet =
        document.contains("transmission") &&
        (document.contains("metal") || document.contains("cover") ||
         (profile["type"] == "table" && document["transmission"].value("reflectance", 0.0) > 0.0));
    const bool few = grating.value("grooves", 1500.0) < 50.0 && (profile["type"] == "table" || lobe.contains("pits"));
    const bool endless = grating.value("orders", json()) == "all" && grating["pitch_nm"] > 190000.0;
    const std::string lamp = document.value("quality", json::object()).value("illuminant", "D65");
    const auto names = colour::illuminant_names();
    const bool dark = lamp != "lamp.csv" && std::find(names.begin(), names.end(), lamp) == names.end();
    return wide || agu || plated_table || plated_sheet || few || endless || dark || crosses_quality(document);
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
    const auto cell = [](const std::string& profile, const std::string& rest) {
        return json::parse(R"({"grating": {"lattice": {"a_nm": [900, 10], "b_nm": [-100, 2000]}, "profile": )" +
                           profile + rest);
    };
    const std::vector<json> documents = {
        cell(R"({"type": "aperture", "width_nm": 500, "height_nm": 600})", R"(, "orders": 3}})"),
        cell(R"({"type": "height_map", "file": "cell.png", "depth_nm": 100})", R"(}, "cover": {"ior": 1.5}})"),
        cell(
            R"({"type": "crossed", "along_a": {"type": "lamellar", "duty": 0.4, "depth_nm": 100}, "along_b": {"type": "sinusoidal", "depth_nm": 90}})",
            R"(}, "metal": "Al", "quality": {"representation": "planar"}})"),
        read("content/materials/cd.json"),
        read("content/materials/cd_paper.json"),
        material(R"({"type": "lamellar", "duty": 0.4, "depth_nm": 100})", R"(, "groove_lobe": {"sigma": 0.2}}})"),
        material(R"({"type": "blazed", "depth_nm": 100}})",
                 R"(, "metal": "Au", "quality": {"max_error": 0.1, "illuminant": "F11"}})"),
        pinned(
            R"({"max_error": 0.1, "measure": "hdr_flip", "surface": "curved", "probes": ["a.json", {"image": "b.hdr", "mapping": "angular"}]})"),
        material(R"({"type": "slit", "width_nm": 0.5}, "normalization": "agu", "orders": "all"}})", ""),
        material(R"({"type": "blazed", "depth_nm": 100}})", R"(, "cover": {"ior": 1.5, "tint": [0.25, 1, 0]}})"),
        material(R"({"type": "lamellar", "duty": 0.5, "depth_nm": 500}})",
                 R"(, "transmission": {"ior": 1.5, "reflectance": 0.25}})"),
        material(R"({"type": "table", "file": "t.csv"}})", R"(, "base": {"roughness": 0.1}})"),
        material(R"({"type": "sinusoidal", "depth_nm": 90})",
                 R"(, "groove_lobe": {"pits": {"length_nm": 850, "coherent": 0.3}}}})"),
        pinned(R"({"representation": "spikes", "spikes": 8, "view_mapping": "parabolic", "key_lights": 64})"),
        pinned(R"({"representation": "bins", "bins": 9, "bands": 4, "view_resolution": 20, "storage": "unorm8"})"),
        pinned(R"({"representation": "transfer", "bands": 3, "view_mapping": "spherical", "max_error": 0.2})"),
        pinned(
            R"({"representation": "arc", "bands": 6, "rank": 12, "storage": "fp32", "key_lights": 0, "illuminant": "A"})"),
        pinned(R"({"representation": "direct", "key_lights": 64, "illuminant": "lamp.csv"})"),
        pinned(R"({"representation": "planar", "rank": 6, "map_resolution": 128})"),
        pinned(R"({"representation": "circle", "map_resolution": 32})"),
        material(R"({"type": "slit", "width_nm": 700}, "groove_lobe": {"sigma": 0.1}})",
                 R"(, "quality": {"representation": "streak", "map_resolution": 160, "bands": 4, "rank": 6}})")};
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
                        "grooveRotation": 1.5, "grooveTexture": {"index": 2, "texCoord": 1}, "metal": "Cu",
                        "cover": {"ior": 1.49}})"),
        json::parse(R"({"grating": {"pitch_nm": 740, "profile": {"type": "table", "file": "t.csv"}},
                        "grooveTexture": {"index": 0, "sparkle": true, "extras": {}}, "extras": [1], "extensions": {"X": 1}})")};
    expect_agreement(
        schema, documents,
        [&](const json& document) { diffraction::parse_gltf_extension(document, "test", folder.path()); },
        [](const json& document) { return crosses_members(document) || names_another_file(document); });
}

TEST(Schema, OfFilmsAgreesWithTheParser) {
    const std::vector<json> documents = {
        json::parse(R"({"film": {"ior": 1.33, "k": 0.1, "thickness_nm": 400}, "base": {"ior": 1.5, "k": 2},
                        "roughness": 0.3, "illuminant": "F11"})"),
        json::parse(
            R"({"film": [{"ior": 1.4, "thickness_nm": 90}, {"ior": 2.3, "thickness_nm": 60}], "metal": "Au"})")};
    expect_agreement(
        read("modules/thin_film/asset/film.schema.json"), documents,
        [](const json& document) { thin_film::parse_film_material(document, "test"); },
        [](const json&) { return false; });
}

TEST(Schema, OfProbeRecipesAgreesWithTheParser) {
    const std::vector<json> documents = {
        read("content/probes/studio.json"),
        read("content/probes/clear_sky.json"),
        read("content/probes/night.json"),
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

/// What the members of a shape forbid one another, and the points of a profile.
bool crosses_shape(const json& shape) {
    if (shape["type"] == "disc") return shape["outer_radius"] <= shape["inner_radius"];
    if (shape["type"] == "box") {
        const double radius = shape.value("corner_radius", 0.0);
        double most = std::min(shape["size"][0].get<double>(), shape["size"][2].get<double>()) / 2.0;
        if (radius > most) return true;
        most = std::min(most, shape["size"][1].get<double>() / 2.0);
        if (radius > 0.0) most = std::min(most, radius);
        return shape.value("bevel", 0.0) >= most;
    }
    if (shape["type"] != "lathe") return false;
    const json turn = shape.value("longitude_deg", json::array({0, 360}));
    if (turn[1].get<double>() - turn[0].get<double>() < 1.0) return true;
    const json& profile = shape["profile"];
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const double radius = profile[i][0].get<double>();
        const bool end = i == 0 || i + 1 == profile.size();
        if (radius < 1e-7 && !(radius == 0.0 && end)) return true;
        if (i > 0 && profile[i] == profile[i - 1]) return true;
    }
    return profile.size() == 2 && profile[0][0] == 0 && profile[1][0] == 0;
}

TEST(Schema, OfMeshRecipesAgreesWithTheParser) {
    const std::vector<json> documents = {
        read("content/meshes/cd.json"), read("content/meshes/sphere.json"), read("content/meshes/ground.json"),
        json::parse(R"({"mesh": {"type": "lathe", "profile": [[0, -1], [2, 0.5], [0.5, 3]], "smooth": true, "steps": 4,
                        "segments": 9, "longitude_deg": [10, 200], "flatten": 0.7, "tangent": "along"}})"),
        json::parse(R"({"mesh": {"type": "box", "size": [3, 2, 4], "corner_radius": 0.5, "corner_steps": 3,
                        "bevel": 0.1, "faces": ["top", "sides"]}})")};
    expect_agreement(
        read("engine/scene/mesh_recipe.schema.json"), documents,
        [](const json& document) { scene::parse_mesh_recipe(document, "test"); },
        [](const json& document) { return crosses_shape(document["mesh"]); });
}

/// The schema with the shapes of mesh recipes, which it refers to, within it.
json scene_recipe_schema() {
    std::string text = read("engine/scene/scene_recipe.schema.json").dump();
    const std::string other = "mesh_recipe.schema.json#";
    text.replace(text.find(other), other.size(), "#");
    json schema = json::parse(text);
    schema["$defs"].update(read("engine/scene/mesh_recipe.schema.json")["$defs"]);
    return schema;
}

bool is_name_of_one(const json& name, const json& among) {
    return std::any_of(among.begin(), among.end(), [&](const json& one) { return one["name"] == name; });
}

/// Names that are there twice, names of what is not there, intervals that end before they begin.
bool crosses_scene(const json& document) {
    const json& scene = document["scene"];
    const auto all = [&](const char* key) { return scene.value(key, json::array()); };
    for (const char* key : {"textures", "materials", "meshes", "cameras", "lights", "nodes"}) {
        std::set<json> names;
        for (const json& one : all(key))
            if (!names.insert(one["name"]).second) return true;
    }
    for (const json& texture : all("textures"))
        for (const json& layer : texture["layers"])
            for (const char* channel : {"r", "g", "b", "a"}) {
                const json value = layer.value(channel, json());
                if (value.is_object() && value.contains("over") && value["over"][0] >= value["over"][1]) return true;
            }
    for (const json& material : all("materials"))
        if (material.contains("color_texture") && !is_name_of_one(material["color_texture"]["name"], all("textures")))
            return true;
    for (const json& mesh : all("meshes"))
        for (const json& part : mesh["parts"])
            if (crosses_shape(part["shape"]) || !is_name_of_one(part["material"], all("materials"))) return true;
    for (const json& light : all("lights"))
        if (light.value("inner_cone_deg", 0.0) >= light.value("outer_cone_deg", 89.0)) return true;
    json before = json::array();
    for (const json& node : all("nodes")) {
        const auto lost = [&](const char* key, const json& among) {
            return node.contains(key) && !is_name_of_one(node[key], among);
        };
        if (lost("parent", before) || lost("mesh", all("meshes")) || lost("camera", all("cameras")) ||
            lost("light", all("lights")))
            return true;
        const json position = node.value("translation", json::array({0, 0, 0}));
        if (node.contains("look_at") && (node.contains("yaw_pitch_roll_deg") || node["look_at"] == position))
            return true;
        before.push_back(node);
    }
    return false;
}

TEST(Schema, OfSceneRecipesAgreesWithTheParser) {
    const std::vector<json> documents = {
        json::parse(R"({"scene": {"textures": [{"name": "a", "size": [8, 4], "layers": [
            {"pattern": "all", "r": 0.5, "a": {"by": "x", "from": 0, "to": 1, "over": [0.25, 0.75], "repeat": 2}},
            {"pattern": "tiles", "size": [0.5, 0.25], "gap": 0.1, "g": 1},
            {"pattern": "hexagons", "size": 0.5, "gap": 0.1, "b": 0},
            {"pattern": "rosette", "centre": [1, 0.5], "radius": 0.4, "petals": 5, "petal_depth": 0.25, "rings": 2,
             "gap": 0.5}]},
            {"name": "b", "picture": "b.png", "wrap_x": "clamp"}]}})"),
        json::parse(R"({"scene": {
            "textures": [{"name": "a", "size": [1, 1], "layers": []}],
            "materials": [{"name": "m", "color": [0.5, 0, 1], "alpha": 0.5, "metallic": 1, "roughness": 0.25,
                           "emission": [1, 0.5, 0.25], "color_texture": {"name": "a", "repeat": [2, 3]}, "blend": true, "double_sided": false,
                           "extensions": {"X": 1}}],
            "meshes": [{"name": "s", "parts": [{"shape": {"type": "sphere", "radius": 0.5}, "material": "m"}]}],
            "nodes": [{"name": "top", "mesh": "s", "extras": {}}]}})"),
        json::parse(R"({"scene": {
            "cameras": [{"name": "c", "vertical_field_of_view_deg": 30, "near": 0.125, "far": 50}],
            "lights": [{"name": "d", "type": "directional", "color": [1, 0.5, 0], "intensity": 2},
                       {"name": "s", "type": "spot", "intensity": 2, "outer_cone_deg": 40, "inner_cone_deg": 20}],
            "nodes": [{"name": "n", "translation": [1, 2, 3.25], "yaw_pitch_roll_deg": [10, 20, 30], "scale": 2},
                      {"name": "k", "parent": "n", "look_at": [7, 0, 0], "camera": "c", "light": "s"}]}})")};
    expect_agreement(
        scene_recipe_schema(), documents, [](const json& document) { scene::parse_scene_recipe(document, "test"); },
        crosses_scene);
}

TEST(Schema, OfSceneRecipesAllowsTheShippedScenes) {
    for (const char* scene : {"content/scenes/cabinet.json", "content/scenes/films.json",
                              "content/scenes/lattices.json", "content/scenes/sheets.json"})
        EXPECT_TRUE(test::satisfies(read(scene), scene_recipe_schema())) << scene;
}

TEST(Schema, GratingsOfTheShippedSceneAreOnesTheModuleReads) {
    const json recipe = read("content/scenes/cabinet.json");
    std::vector<double> pitches;
    bool varies = false;
    for (const json& material : recipe["scene"]["materials"]) {
        const json extensions = material.value("extensions", json::object());
        const auto extension = extensions.find(diffraction::kGltfExtension);
        if (extension == extensions.end()) continue;
        const diffraction::GltfGrating grating = diffraction::parse_gltf_extension(
            *extension, "cabinet.json", ".", "/" + material["name"].get<std::string>());
        pitches.push_back(grating.material.grating.pitch_nm);
        if (!grating.groove_texture) continue;
        varies = true;
        EXPECT_LT(static_cast<std::size_t>(grating.groove_texture->index), recipe["scene"]["textures"].size());
    }
    EXPECT_EQ(pitches.size(), 6U);
    EXPECT_TRUE(varies);
}

}  // namespace
}  // namespace rowland
