#include "engine/scene/cooked_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/scene/gltf_import.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::scene {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::vector<std::byte> bytes_of(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

/// Tables of an extension {"colour": …, "turn": …}: its colour, and what the file beside the scene holds.
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
        for (const std::byte byte : bytes_of(at.object["colour"])) tables.push_back(byte);
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
            {"name": "a", "extensions": {"TEST_colour": {"colour": "red", "turn": 1}}}, {"name": "plain"},
            {"name": "b", "extensions": {"TEST_colour": {"colour": "red", "turn": 2}, "OTHER": {}}},
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
    EXPECT_EQ(scene.materials[2].extensions.at("TEST_colour")["turn"], 2);
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
    EXPECT_THAT(rowland::test::message_of([&] { cook(scene_); }),
                HasSubstr("s.gltf: /materials/0/extensions/TEST_colour: no colour"));
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
    EXPECT_THAT(rowland::test::message_of([&] { require_texture(scene, 2, "scene.gltf", "/grooveTexture"); }),
                testing::AllOf(HasSubstr("scene.gltf: /grooveTexture/index: 2"), HasSubstr("2 textures")));
}

}  // namespace
}  // namespace rowland::scene
