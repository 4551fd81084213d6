#include "engine/scene/scene_recipe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>
#include <stdexcept>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/image/png.h"
#include "engine/scene/gltf_import.h"
#include "tests/support/message_of.h"
#include "tests/support/source_tree.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

using nlohmann::json;
using rowland::test::message_of;

const char* const kExtension = "ROWLAND_materials_diffraction";

json small_scene() {
    return json::parse(R"({"scene": {
        "textures": [{"name": "paint", "size": [4, 2], "wrap_x": "clamp", "layers": [{"pattern": "all", "r": 0.2, "g": 0.4, "b": 0.6}]}],
        "materials": [{"name": "plain", "color": [0.5, 0.25, 1], "metallic": 1, "roughness": 0.75,
                       "emission": [1, 0.5, 0.25]},
                      {"name": "painted", "color_texture": {"name": "paint", "repeat": [2, 3]}, "blend": true,
                       "extensions": {"X_unknown": {"deep": [1, {"a": null}], "text": "é"}}}],
        "meshes": [{"name": "ball", "parts": [{"shape": {"type": "sphere", "radius": 0.5, "rings": 6, "segments": 8},
                                               "material": "plain"},
                                              {"shape": {"type": "box", "size": [1, 2, 3]}, "material": "painted"}]}],
        "cameras": [{"name": "lens", "vertical_field_of_view_deg": 90, "near": 0.125, "far": 50}],
        "lights": [{"name": "sun", "type": "directional", "color": [1, 0.5, 0.25], "intensity": 3},
                   {"name": "lamp", "type": "spot", "intensity": 2, "outer_cone_deg": 40, "inner_cone_deg": 20}],
        "nodes": [{"name": "root", "translation": [1, 2, 3], "yaw_pitch_roll_deg": [90, 0, 0]},
                  {"name": "child", "parent": "root", "translation": [0, 0, -1], "mesh": "ball", "scale": 2,
                   "extras": {"grab": true, "spin_axis": [0, 1, 0]}},
                  {"name": "eye", "translation": [0, 0, 5], "look_at": [0, 3, 5], "camera": "lens"},
                  {"name": "sun", "look_at": [0, -1, -1], "light": "sun"},
                  {"name": "lamp", "parent": "child", "light": "lamp"}]}})");
}

std::vector<std::byte> cooked(const json& document) {
    return write_glb(build_scene(parse_scene_recipe(document, "s.json")));
}

json header_of(const std::vector<std::byte>& glb) {
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, sizeof length);
    return json::parse(std::string(reinterpret_cast<const char*>(glb.data()) + 20, length));
}

std::string error_of(const std::function<void(json&)>& change) {
    json document = small_scene();
    change(document["scene"]);
    return message_of([&] { build_scene(parse_scene_recipe(document, "s.json")); });
}

const glm::mat4& world_of(const ImportedScene& scene, const std::string& name) {
    const auto found = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                    [&](const ImportedNode& node) { return node.name == name; });
    if (found == scene.nodes.end()) throw std::runtime_error("no node " + name);
    return found->world;
}

TEST(SceneRecipe, ImportFindsWhatTheRecipeSays) {
    const ImportedScene scene = load_glb(cooked(small_scene()), "s.glb");
    EXPECT_TRUE(test::is_sane(scene));
    EXPECT_THAT(scene.warnings, testing::ElementsAre("the extension X_unknown is ignored"));
    ASSERT_EQ(scene.nodes.size(), 5U);
    EXPECT_EQ(scene.nodes[0].name, "root");
    ASSERT_EQ(scene.instances.size(), 2U);
    EXPECT_EQ(scene.meshes[scene.instances[0].mesh].positions.size(), 5U * 9U + 16U);
    ASSERT_EQ(scene.materials.size(), 2U);
    const MaterialDescription& plain = scene.materials[scene.instances[0].material.value()];
    EXPECT_EQ(plain.name, "plain");
    EXPECT_EQ(plain.base_colour, glm::vec4(0.5F, 0.25F, 1.0F, 1.0F));
    EXPECT_EQ(plain.metallic, 1.0F);
    EXPECT_EQ(plain.roughness, 0.75F);
    EXPECT_EQ(plain.emissive, glm::vec3(1.0F, 0.5F, 0.25F));
    const MaterialDescription& painted = scene.materials[scene.instances[1].material.value()];
    EXPECT_EQ(painted.alpha_mode, AlphaMode::Blend);
    ASSERT_TRUE(painted.base_colour_texture);
    EXPECT_EQ(painted.base_colour_texture->transform.scale, glm::vec2(2.0F, 3.0F));
    EXPECT_EQ(scene.textures[painted.base_colour_texture->texture].wrap_s, TextureWrap::Clamp);
    EXPECT_EQ(scene.textures[painted.base_colour_texture->texture].wrap_t, TextureWrap::Repeat);
    const image::ByteImage& image = *scene.images.at(scene.textures.at(painted.base_colour_texture->texture).image);
    EXPECT_EQ(image.width, 4);
    EXPECT_THAT(std::vector<int>(image.rgba.begin(), image.rgba.begin() + 4), testing::ElementsAre(51, 102, 153, 255));
}

TEST(SceneRecipe, ExtensionsAndExtrasPassVerbatim) {
    const json document = small_scene();
    const std::vector<std::byte> glb = cooked(document);
    const json& extension = document["scene"]["materials"][1]["extensions"]["X_unknown"];
    EXPECT_EQ(load_glb(glb, "s.glb").materials[1].extensions.at("X_unknown"), extension);
    const json header = header_of(glb);
    EXPECT_EQ(header["nodes"][1]["extras"], document["scene"]["nodes"][1]["extras"]);
    EXPECT_THAT(header["extensionsUsed"].get<std::vector<std::string>>(),
                testing::ElementsAre("KHR_draco_mesh_compression", "KHR_lights_punctual", "KHR_texture_transform",
                                     "X_unknown"));
    EXPECT_THAT(header["extensionsRequired"].get<std::vector<std::string>>(),
                testing::ElementsAre("KHR_draco_mesh_compression"));
}

TEST(SceneRecipe, NodesStandWhereTheirParentsPutThem) {
    const ImportedScene scene = load_glb(cooked(small_scene()), "s.glb");
    // The root turns by 90° around Y, so its −Z points to −X.
    const glm::mat4 child = world_of(scene, "child");
    EXPECT_LT(glm::distance(glm::vec3(child[3]), glm::vec3(0.0F, 2.0F, 3.0F)), 1e-6F);
    EXPECT_NEAR(glm::length(glm::vec3(child[0])), 2.0F, 1e-6F);
    // The eye looks straight up, the sun down at 45°.
    EXPECT_LT(glm::distance(-glm::vec3(world_of(scene, "eye")[2]), glm::vec3(0.0F, 1.0F, 0.0F)), 1e-6F);
    const glm::vec3 shines = -glm::vec3(world_of(scene, "sun")[2]);
    EXPECT_LT(glm::distance(shines, glm::normalize(glm::vec3(0.0F, -1.0F, -1.0F))), 1e-6F);
}

TEST(SceneRecipe, LightsAndCamerasKeepTheirValues) {
    const std::vector<std::byte> glb = cooked(small_scene());
    const ImportedScene scene = load_glb(glb, "s.glb");
    ASSERT_EQ(scene.lights.size(), 2U);  // in the order of the tree: the lamp is a child of the first root
    const auto& sun = std::get<DirectionalLight>(scene.lights[1].light);
    EXPECT_LT(glm::distance(sun.irradiance, glm::vec3(3.0F, 1.5F, 0.75F)), 1e-6F);
    const auto& lamp = std::get<PunctualLight>(scene.lights[0].light);
    EXPECT_TRUE(lamp.spot);
    EXPECT_EQ(lamp.intensity, glm::vec3(2.0F));
    EXPECT_NEAR(lamp.outer_cone, 0.6981317F, 1e-6F);
    EXPECT_NEAR(lamp.inner_cone, 0.3490659F, 1e-6F);
    const json camera = header_of(glb)["cameras"][0];
    EXPECT_EQ(camera["type"], "perspective");
    EXPECT_NEAR(camera["perspective"]["yfov"].get<double>(), 1.5707963267948966, 1e-15);
    EXPECT_EQ(camera["perspective"]["znear"], 0.125);
    EXPECT_EQ(camera["perspective"]["zfar"], 50);
    EXPECT_EQ(header_of(glb)["nodes"][2]["camera"], 0);
}

TEST(SceneRecipe, SameRecipeGivesSameBytes) {
    EXPECT_EQ(cooked(small_scene()), cooked(small_scene()));
}

TEST(SceneRecipe, ATextureThatChangedIsPaintedAnew) {
    const auto first_texel = [](const json& recipe) {
        const ImportedScene scene = load_glb(cooked(recipe), "s.glb");
        const image::ByteImage& image = *scene.images.at(0);
        return std::vector<int>(image.rgba.begin(), image.rgba.begin() + 3);
    };
    json recipe = small_scene();
    EXPECT_THAT(first_texel(recipe), testing::ElementsAre(51, 102, 153));
    recipe["scene"]["textures"][0]["layers"][0]["g"] = 0.8;
    EXPECT_THAT(first_texel(recipe), testing::ElementsAre(51, 204, 153));
    recipe["scene"]["textures"][0]["layers"][0]["g"] = 0.4;
    EXPECT_THAT(first_texel(recipe), testing::ElementsAre(51, 102, 153));
}

TEST(SceneRecipe, RefusalsNameTheirPlace) {
    using testing::AllOf;
    using testing::HasSubstr;
    EXPECT_THAT(error_of([](json& scene) { scene["nods"] = json::array(); }),
                AllOf(HasSubstr("s.json: /scene/nods"), HasSubstr("nodes")));
    EXPECT_THAT(error_of([](json& scene) { scene["nodes"][1]["mesh"] = "bal"; }),
                AllOf(HasSubstr("/scene/nodes/1/mesh"), HasSubstr("is \"ball\" meant?")));
    EXPECT_THAT(error_of([](json& scene) { scene["nodes"][0]["parent"] = "child"; }),
                HasSubstr("/scene/nodes/0/parent"));
    EXPECT_THAT(error_of([](json& scene) { scene["nodes"][2]["name"] = "root"; }), HasSubstr("/scene/nodes/2/name"));
    EXPECT_THAT(error_of([](json& scene) {
                    scene["nodes"][2]["look_at"] = {0, 0, 5};
                }),
                HasSubstr("/scene/nodes/2/look_at"));
    EXPECT_THAT(error_of([](json& scene) {
                    scene["nodes"][2]["yaw_pitch_roll_deg"] = {0, 0, 0};
                }),
                HasSubstr("/scene/nodes/2/yaw_pitch_roll_deg"));
    EXPECT_THAT(error_of([](json& scene) { scene["meshes"][0]["parts"][1]["shape"]["sise"] = 1; }),
                AllOf(HasSubstr("/scene/meshes/0/parts/1/shape/sise"), HasSubstr("size")));
    EXPECT_THAT(error_of([](json& scene) { scene["meshes"][0]["parts"][0]["material"] = "gold"; }),
                HasSubstr("/scene/meshes/0/parts/0/material"));
    EXPECT_THAT(error_of([](json& scene) { scene["materials"][1]["extensions"] = 3; }),
                HasSubstr("/scene/materials/1/extensions"));
    EXPECT_THAT(error_of([](json& scene) { scene["lights"][1].erase("outer_cone_deg"); }),
                HasSubstr("/scene/lights/1/outer_cone_deg"));
    EXPECT_THAT(error_of([](json& scene) { scene["cameras"][0]["near"] = 0; }), HasSubstr("/scene/cameras/0/near"));
}

TEST(SceneRecipe, APictureIsCopiedAsItIs) {
    const std::vector<std::uint8_t> texels = {255, 0, 0, 0, 255, 0};
    const std::vector<std::byte> png = image::encode_png(2, 1, 3, texels);
    std::vector<std::string> read;
    const auto scene_with = [&](const std::vector<std::byte>& bytes) {
        json document = small_scene();
        document["scene"]["textures"][0] = {{"name", "paint"}, {"picture", "p.png"}};
        return build_scene(parse_scene_recipe(document, "folder/s.json"),
                           [&](const std::filesystem::path& path, std::uint64_t) {
                               read.push_back(path.string());
                               return bytes;
                           });
    };
    EXPECT_EQ(scene_with(png).textures[0].png, png);
    EXPECT_THAT(read, testing::ElementsAre("folder/p.png"));
    EXPECT_THAT(message_of([&] { scene_with(std::vector<std::byte>(8)); }), testing::HasSubstr("folder/p.png"));
    EXPECT_THAT(message_of([&] { scene_with({png.begin(), png.end() - 20}); }), testing::HasSubstr("folder/p.png"));
    EXPECT_THAT(error_of([](json& scene) {
                    scene["textures"][0] = {{"name", "paint"}, {"picture", "none.png"}};
                }),
                testing::HasSubstr("none.png"));
    EXPECT_THAT(error_of([](json& scene) { scene["textures"][0]["picture"] = "p.png"; }),
                testing::HasSubstr("/scene/textures/0/layers"));
}

TEST(SceneRecipe, UnreasonableSizesAreRefused) {
    using testing::HasSubstr;
    EXPECT_THAT(error_of([](json& scene) {
                    scene["textures"][0]["size"] = {8192, 8192};
                }),
                HasSubstr("/scene/textures/0/size"));
    EXPECT_THAT(error_of([](json& scene) {
                    const json part = {{"material", "plain"},
                                       {"shape", {{"type", "plane"}, {"size", {1, 1}}, {"subdivisions", 2048}}}};
                    scene["meshes"][0]["parts"] = {part, part};
                }),
                HasSubstr("/scene/meshes/0: "));
}

class Cabinet : public testing::Test {
 protected:
    json recipe_ = parse_json(read_text_file(rowland::test::content_path("scenes/cabinet.json"), 1 << 20),
                              "cabinet.json")["scene"];
    std::vector<std::byte> glb_ = write_glb(build_scene(
        parse_scene_recipe(parse_json(read_text_file(rowland::test::content_path("scenes/cabinet.json"), 1 << 20), ""),
                           rowland::test::content_path("scenes/cabinet.json").string())));
};

TEST_F(Cabinet, ImportFindsEverythingInIt) {
    const std::vector<std::string> handled = {kExtension};
    const ImportedScene scene = load_glb(glb_, "cabinet.glb", handled);
    EXPECT_TRUE(test::is_sane(scene));
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
    ASSERT_EQ(scene.nodes.size(), recipe_["nodes"].size());
    std::set<std::string> names;
    for (const ImportedNode& node : scene.nodes) names.insert(node.name);
    for (const json& node : recipe_["nodes"]) EXPECT_TRUE(names.contains(node["name"])) << node["name"];
    ASSERT_EQ(scene.materials.size(), recipe_["materials"].size());
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const json& material = recipe_["materials"][i];
        EXPECT_EQ(scene.materials[i].name, material["name"].get<std::string>());
        EXPECT_EQ(json(scene.materials[i].extensions), material.value("extensions", json::object()));
        EXPECT_EQ(scene.materials[i].base_colour_texture.has_value(), material.contains("color_texture"));
    }
    ASSERT_EQ(scene.textures.size(), recipe_["textures"].size());
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        if (!recipe_["textures"][i].contains("size")) continue;
        const image::ByteImage& image = *scene.images.at(scene.textures[i].image);
        EXPECT_EQ(image.width, recipe_["textures"][i]["size"][0]);
        EXPECT_EQ(image.height, recipe_["textures"][i]["size"][1]);
    }
    EXPECT_EQ(scene.lights.size(), 1U);
}

TEST_F(Cabinet, LoadsWhereTheGratingsAreUnknown) {
    const ImportedScene scene = load_glb(glb_, "cabinet.glb");
    EXPECT_TRUE(test::is_sane(scene));
    EXPECT_THAT(scene.warnings, testing::ElementsAre(std::string("the extension ") + kExtension + " is ignored"));
}

TEST_F(Cabinet, HoldsAsManyVerticesAsAFrameCanBear) {
    const ImportedScene scene = load_glb(glb_, "cabinet.glb");
    std::size_t vertices = 0;
    for (const ImportedInstance& instance : scene.instances) vertices += scene.meshes[instance.mesh].positions.size();
    EXPECT_GT(vertices, 60000U);
    EXPECT_LT(vertices, 120000U);
}

TEST_F(Cabinet, ThingsHaveTheirRealSizes) {
    const ImportedScene scene = load_glb(glb_, "cabinet.glb");
    // Across a thing as it lies in its own axes, in millimetres.
    const auto across = [&](const std::string& name) {
        glm::vec3 least(1e9F);
        glm::vec3 most(-1e9F);
        for (const ImportedInstance& instance : scene.instances) {
            if (instance.name != name) continue;
            const Bounds box = bounds(scene.meshes[instance.mesh]);
            least = glm::min(least, box.minimum);
            most = glm::max(most, box.maximum);
        }
        return 1000.0F * (most - least);
    };
    // Float rounding and 16 bits of quantisation, 2.3 µm on the record.
    EXPECT_NEAR(across("CD").x, 120.0F, 0.01F);
    EXPECT_NEAR(across("DVD").x, 120.0F, 0.01F);
    EXPECT_NEAR(across("record").x, 301.0F, 0.01F);
    EXPECT_NEAR(across("foil card").x, 85.6F, 0.01F);
    EXPECT_NEAR(across("foil card").z, 54.0F, 0.01F);
    EXPECT_NEAR(across("grating rule").x, 200.0F, 0.01F);
    EXPECT_NEAR(across("grating rule").z, 30.0F, 0.01F);
}

TEST_F(Cabinet, FoilVariesDirectionAndPitchByItsTexture) {
    const ImportedScene scene = load_glb(glb_, "cabinet.glb");
    const auto foil = std::find_if(scene.materials.begin(), scene.materials.end(), [](const MaterialDescription& m) {
        return m.extensions.contains(kExtension) && m.extensions.at(kExtension).contains("grooveTexture");
    });
    ASSERT_NE(foil, scene.materials.end());
    const json& extension = foil->extensions.at(kExtension);
    const double pitch_nm = extension["grating"]["pitch_nm"].get<double>();
    const auto texture = extension["grooveTexture"]["index"].get<std::size_t>();
    const image::ByteImage& image = *scene.images.at(scene.textures.at(texture).image);
    std::set<int> directions;
    double finest = 1e9;
    double coarsest = 0.0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        directions.insert(image.rgba[i]);
        const double pitch = image.rgba[i + 1] / 255.0 * 2.0 * pitch_nm;
        finest = std::min(finest, pitch);
        coarsest = std::max(coarsest, pitch);
    }
    EXPECT_GT(directions.size(), 200U);
    EXPECT_GE(finest, 600.0);
    EXPECT_LE(finest, 650.0);
    EXPECT_GE(coarsest, 1450.0);
    EXPECT_LE(coarsest, 1550.0);
}

}  // namespace
}  // namespace rowland::scene
