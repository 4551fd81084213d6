#include "engine/scene/cook.h"

#include <gmock/gmock.h>

#include "engine/core/json_reader.h"
#include "engine/scene/gltf_import.h"
#include "tests/support/expect.h"
#include "tests/support/folder_test.h"

namespace rowland::scene {
namespace {

using rowland::test::bytes_of;
using rowland::test::message_of;
using testing::Contains;
using testing::HasSubstr;

const char* const kRecipe =
    R"({"mesh": {"type": "disc", "inner_radius": 0.02, "outer_radius": 0.06, "rings": 4, "segments": 16}})";

class SceneCook : public rowland::test::FolderTest {
 protected:
    SceneCook() { register_cook_types(registry_); }

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
    EXPECT_THAT(context.dependencies(), Contains(source));
    EXPECT_THAT(type.describe(payload, "cd.glb"), HasSubstr("vertices: 85\n"));
    EXPECT_THROW(type.describe(std::span(payload).first(payload.size() / 2), "cd.glb"), Error);
}

TEST_F(SceneCook, BrokenRecipeIsRefusedByName) {
    const std::filesystem::path source = write("cd.json", R"({"mesh": {"type": "disc"}})");
    cook::Context context(source);
    EXPECT_THAT(message_of([&] { registry_.type_of_source(source).check(context); }),
                HasSubstr("cd.json: /mesh/inner_radius"));
}

TEST_F(SceneCook, GltfIsCheckedWithAllThatItNames) {
    ROWLAND_TEST_DATA(path, "gltf/valid/Duck/glTF/Duck.gltf");
    const cook::AssetType& type = registry_.type_of_source(path);
    EXPECT_EQ(type.name, "scene");
    cook::Context context(path);
    type.check(context);
    EXPECT_THAT(context.dependencies(), Contains(path.parent_path() / "Duck0.bin"));
    EXPECT_THAT(context.dependencies(), Contains(path.parent_path() / "DuckCM.png"));
    ROWLAND_TEST_DATA(broken, "gltf/malformed/crash/draco_uid77.glb");
    cook::Context broken_context(broken);
    EXPECT_THROW(registry_.type_of_source(broken).check(broken_context), Error);
}

TEST_F(SceneCook, GltfWithABrokenPictureIsRefused) {
    write("broken.png", "\x89PNG\r\n\x1a\nbut nothing more");
    const std::filesystem::path source = write(
        "f.gltf", R"({"asset": {"version": "2.0"}, "images": [{"uri": "broken.png"}], "textures": [{"source": 0}]})");
    cook::Context context(source);
    EXPECT_THAT(message_of([&] { registry_.type_of_source(source).check(context); }), HasSubstr("f.gltf: /images/0"));
}

TEST_F(SceneCook, GltfIsDescribedByWhatItHolds) {
    ROWLAND_TEST_DATA(path, "gltf/valid/Duck/glTF_Binary/Duck.glb");
    cook::Context context(path);
    const std::string text = registry_.type_of_source(path).describe_source(context);
    for (const char* line : {"vertices: 2399\n", "nodes: 3\n", "meshes: 1\n", "materials: 1\n", "textures: 1\n",
                             "skins: 0\n", "animations: 0\n", "lights: 0\n"})
        EXPECT_THAT(text, HasSubstr(line));
}

/// Tables of an extension {"colour": …, "size": …}: its colour, and what the file beside the scene holds.
cook::GltfExtension colour_extension() {
    cook::GltfExtension extension;
    extension.name = "TEST_colour";
    extension.version = 5;
    extension.describe = [](const nlohmann::json& object, const std::string& file, const std::string& pointer) {
        if (!object.contains("colour")) refuse_input(file, pointer, "no colour", "one");
        return object["colour"].get<std::string>();
    };
    extension.cook = [](cook::Context& context, const cook::SceneExtension& at) {
        std::vector<std::byte> tables = context.read(context.beside_source("shade.txt"), 1000);
        for (const std::byte byte : bytes_of(at.object["colour"].get<std::string>())) tables.push_back(byte);
        return tables;
    };
    extension.describe_tables = [](std::span<const std::byte> tables, const std::string&) {
        return "shade: " + std::string(reinterpret_cast<const char*>(tables.data()), tables.size()) + "\n";
    };
    return extension;
}

class CookedScene : public testing::Test {
 protected:
    CookedScene() {
        registry_.add_gltf_extension(colour_extension());
        register_scene_type(registry_);
        write_file_atomic(folder_.path() / "shade.txt", "dark ");
        write_file_atomic(scene_, R"({"asset": {"version": "2.0"}, "materials": [
            {"name": "a", "extensions": {"TEST_colour": {"colour": "red", "size": 1}}}, {"name": "plain"},
            {"name": "b", "extensions": {"TEST_colour": {"colour": "red", "size": 2}, "OTHER": {}}},
            {"name": "c", "extensions": {"TEST_colour": {"colour": "blue"}}}]})");
    }

    const cook::AssetType& type() const { return *registry_.find(kSceneAssetType); }
    std::vector<std::byte> cook(const std::filesystem::path& source) const {
        cook::Context context(source);
        return type().cook(context);
    }
    ImportedScene read(std::span<const std::byte> payload) const {
        return read_cooked_scene(payload, "s.scene", registry_.gltf_extension_names());
    }

    rowland::test::TemporaryFolder folder_;
    std::filesystem::path scene_ = folder_.path() / "s.gltf";
    cook::Registry registry_;
};

TEST_F(CookedScene, HasTheTablesOfEachExtensionAndEqualOnesOnce) {
    cook::Context context(scene_);
    const std::vector<std::byte> payload = type().cook(context);
    EXPECT_THAT(context.dependencies(), testing::ElementsAre(scene_, folder_.path() / "shade.txt"));
    EXPECT_EQ(cook(scene_), payload);
    const ImportedScene scene = read(payload);
    ASSERT_EQ(scene.materials.size(), 4U);
    const auto tables = [&](std::size_t i) { return scene.materials[i].tables.at("TEST_colour"); };
    EXPECT_EQ(*tables(0), bytes_of("dark red"));
    EXPECT_EQ(tables(2), tables(0));
    EXPECT_EQ(*tables(3), bytes_of("dark blue"));
    EXPECT_TRUE(scene.materials[1].tables.empty());
    EXPECT_EQ(scene.materials[2].extensions.at("TEST_colour")["size"], 2);
    EXPECT_THAT(type().describe(payload, "s.scene"),
                testing::AllOf(HasSubstr("material: 0 \"a\"\nextension: TEST_colour\nbytes: 8\nshade: dark red\n"),
                               HasSubstr("material: 3 \"c\"\nextension: TEST_colour\nbytes: 9\nshade: dark blue\n")));
    EXPECT_THAT(type().describe_source(context), HasSubstr("material: 0 \"a\"\nextension: TEST_colour\nobject: red\n"));
}

TEST_F(CookedScene, IsOfAnotherVersionWhenAnExtensionIs) {
    cook::Registry newer;
    cook::GltfExtension extension = colour_extension();
    ++extension.version;
    newer.add_gltf_extension(extension);
    register_scene_type(newer);
    EXPECT_GT(newer.find(kSceneAssetType)->version, type().version);
}

TEST_F(CookedScene, ARefusedExtensionIsNamedByItsPointer) {
    write_file_atomic(
        scene_, R"({"asset": {"version": "2.0"}, "materials": [{"extensions": {"TEST_colour": {"color": "red"}}}]})");
    EXPECT_THAT(message_of([&] { cook(scene_); }), HasSubstr("s.gltf: /materials/0/extensions/TEST_colour: no colour"));
}

TEST_F(CookedScene, CutOrLengthenedIsRefused) {
    std::vector<std::byte> payload = cook(scene_);
    for (std::size_t size = 0; size < payload.size(); ++size)
        EXPECT_THROW(read(std::span(payload).first(size)), Error) << size;
    payload.push_back(std::byte{0});
    EXPECT_THROW(read(payload), Error);
    payload.pop_back();
    payload[payload.size() - 4] = std::byte{9};  // the last use's table
    EXPECT_THROW(read(payload), Error);
}

/// The same scene however its buffers and pictures are stored.
TEST_F(CookedScene, HoldsEverythingThatTheSourceNames) {
    for (const char* name : {"gltf/valid/Duck/glTF/Duck.gltf", "gltf/valid/Duck/glTF_Binary/Duck.glb"}) {
        ROWLAND_TEST_DATA(path, name);
        const ImportedScene source = load_gltf(path);
        const ImportedScene cooked = read(cook(path));
        ASSERT_EQ(cooked.meshes.size(), source.meshes.size()) << name;
        EXPECT_EQ(cooked.meshes[0].positions, source.meshes[0].positions) << name;
        EXPECT_EQ(cooked.meshes[0].indices, source.meshes[0].indices) << name;
        ASSERT_EQ(cooked.images.size(), source.images.size()) << name;
        EXPECT_EQ(cooked.images[0]->rgba, source.images[0]->rgba) << name;
        EXPECT_EQ(cooked.nodes.size(), source.nodes.size()) << name;
    }
}

TEST(RequireTexture, AnIndexBeyondTheFilesTexturesIsRefusedWithItsLocation) {
    ImportedScene scene;
    scene.textures.resize(2);
    EXPECT_NO_THROW(require_texture(scene, 1, "scene.gltf", "/grooveTexture"));
    EXPECT_THAT(message_of([&] { require_texture(scene, 2, "scene.gltf", "/grooveTexture"); }),
                testing::AllOf(HasSubstr("scene.gltf: /grooveTexture/index: 2"), HasSubstr("2 textures")));
}

}  // namespace
}  // namespace rowland::scene
