#include "engine/scene/cook.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/scene/gltf_import.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::scene {
namespace {

const char* const kRecipe =
    R"({"mesh": {"type": "disc", "inner_radius": 0.02, "outer_radius": 0.06, "rings": 4, "segments": 16}})";

class SceneCook : public testing::Test {
 protected:
    SceneCook() { register_cook_types(registry_); }

    std::filesystem::path write(const std::string& name, std::string_view text) {
        write_file_atomic(folder_.path() / name, text);
        return folder_.path() / name;
    }

    rowland::test::TemporaryFolder folder_;
    cook::Registry registry_;
};

TEST_F(SceneCook, RecipeBecomesAGlb) {
    const std::filesystem::path source = write("cd.json", kRecipe);
    const cook::AssetType& type = registry_.type_of_source(source);
    EXPECT_EQ(type.name, "mesh");
    EXPECT_EQ(type.extension, ".glb");
    EXPECT_FALSE(type.in_container);
    cook::Context context(source);
    const std::vector<std::byte> payload = type.cook(context);
    EXPECT_EQ(load_glb(payload, "cd.glb").meshes.at(0).positions.size(), 5U * 17U);
    EXPECT_THAT(context.dependencies(), testing::Contains(source));
    EXPECT_THAT(type.describe(payload, "cd.glb"), testing::HasSubstr("vertices: 85\n"));
    EXPECT_THROW(type.describe(std::span(payload).first(payload.size() / 2), "cd.glb"), Error);
}

TEST_F(SceneCook, BrokenRecipeIsRefusedByName) {
    const std::filesystem::path source = write("cd.json", R"({"mesh": {"type": "disc"}})");
    cook::Context context(source);
    try {
        registry_.type_of_source(source).check(context);
        FAIL() << "was not refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("cd.json: /mesh/inner_radius"));
    }
}

TEST_F(SceneCook, GltfIsCheckedWithAllThatItNames) {
    ROWLAND_TEST_DATA(path, "gltf/valid/Duck/glTF/Duck.gltf");
    const cook::AssetType& type = registry_.type_of_source(path);
    EXPECT_EQ(type.name, "scene");
    cook::Context context(path);
    type.check(context);
    EXPECT_THAT(context.dependencies(), testing::Contains(path.parent_path() / "Duck0.bin"));
    EXPECT_THAT(context.dependencies(), testing::Contains(path.parent_path() / "DuckCM.png"));
    ROWLAND_TEST_DATA(broken, "gltf/malformed/crash/draco_uid77.glb");
    cook::Context broken_context(broken);
    EXPECT_THROW(registry_.type_of_source(broken).check(broken_context), Error);
}

TEST_F(SceneCook, GltfWithABrokenPictureIsRefused) {
    write("broken.png", "\x89PNG\r\n\x1a\nbut nothing more");
    const std::filesystem::path source = write(
        "f.gltf", R"({"asset": {"version": "2.0"}, "images": [{"uri": "broken.png"}], "textures": [{"source": 0}]})");
    cook::Context context(source);
    EXPECT_THAT(rowland::test::message_of([&] { registry_.type_of_source(source).check(context); }),
                testing::HasSubstr("f.gltf: /images/0"));
}

TEST_F(SceneCook, GltfIsDescribedByWhatItHolds) {
    ROWLAND_TEST_DATA(path, "gltf/valid/Duck/glTF_Binary/Duck.glb");
    cook::Context context(path);
    const std::string text = registry_.type_of_source(path).describe_source(context);
    for (const char* line : {"vertices: 2399\n", "nodes: 3\n", "meshes: 1\n", "materials: 1\n", "textures: 1\n",
                             "skins: 0\n", "animations: 0\n", "lights: 0\n"})
        EXPECT_THAT(text, testing::HasSubstr(line));
}

}  // namespace
}  // namespace rowland::scene
