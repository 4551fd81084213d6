// The JSON Schemas of recipes say what the parsers do, as schema_test.cpp of materials.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "engine/lighting/probe_recipe.h"
#include "engine/scene/mesh_recipe.h"
#include "engine/scene/scene_recipe.h"
#include "tests/support/json_schema.h"
#include "tests/unit/schema_agreement.h"

namespace rowland {
namespace {

using nlohmann::json;
using test::expect_agreement;
using test::read_source;

TEST(Schema, OfProbeRecipesAgreesWithTheParser) {
    const std::vector<json> documents = {
        read_source("content/probes/studio.json"),
        read_source("content/probes/clear_sky.json"),
        read_source("content/probes/night.json"),
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
        read_source("engine/lighting/probe_recipe.schema.json"), documents,
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
        read_source("content/meshes/cd.json"), read_source("content/meshes/sphere.json"),
        read_source("content/meshes/ground.json"),
        json::parse(R"({"mesh": {"type": "lathe", "profile": [[0, -1], [2, 0.5], [0.5, 3]], "smooth": true, "steps": 4,
                        "segments": 9, "longitude_deg": [10, 200], "flatten": 0.7, "tangent": "along"}})"),
        json::parse(R"({"mesh": {"type": "box", "size": [3, 2, 4], "corner_radius": 0.5, "corner_steps": 3,
                        "bevel": 0.1, "faces": ["top", "sides"]}})")};
    expect_agreement(
        read_source("engine/scene/mesh_recipe.schema.json"), documents,
        [](const json& document) { scene::parse_mesh_recipe(document, "test"); },
        [](const json& document) { return crosses_shape(document["mesh"]); });
}

/// The schema with the shapes of mesh recipes, which it refers to, within it.
json scene_recipe_schema() {
    std::string text = read_source("engine/scene/scene_recipe.schema.json").dump();
    const std::string other = "mesh_recipe.schema.json#";
    text.replace(text.find(other), other.size(), "#");
    json schema = json::parse(text);
    schema["$defs"].update(read_source("engine/scene/mesh_recipe.schema.json")["$defs"]);
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
        EXPECT_TRUE(test::satisfies(read_source(scene), scene_recipe_schema())) << scene;
}

}  // namespace
}  // namespace rowland
