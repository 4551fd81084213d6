#include "engine/scene/cook.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "engine/asset/container.h"
#include "engine/core/json_reader.h"
#include "engine/scene/gltf_import.h"
#include "tests/support/expect.h"
#include "tests/support/folder_test.h"

namespace rowland::scene {
namespace {

using rowland::test::bytes_of;
using rowland::test::message_of;
using testing::Contains;
using testing::ElementsAre;
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

/// A stand-in for the engine's type of probes: its payload is a text that begins with "light".
cook::AssetType text_probes() {
    cook::AssetType type;
    type.name = "probe";
    type.version = 7;
    type.recognises = [](const std::filesystem::path&, const nlohmann::json*) { return false; };
    type.check = [](cook::Context&) {};
    type.cook = [](cook::Context&) { return std::vector<std::byte>(); };
    type.describe = [](std::span<const std::byte> payload, const std::string& file) {
        if (payload.empty() || payload[0] != std::byte{'l'}) refuse_input(file, "", "no light", "light");
        return std::string("light\n");
    };
    return type;
}

class ProbeScene : public rowland::test::FolderTest {
 protected:
    ProbeScene() {
        registry_.add(text_probes());
        register_cook_types(registry_);
    }
    void write_probe(const std::string& name, const std::string& text, std::uint32_t version = 7) {
        const std::vector<std::byte> bytes = asset::pack({{"probe", version, {}}, bytes_of(text)});
        write(name, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    }
    std::filesystem::path write_scene(const std::string& probe) {
        return write("room.gltf", R"({"asset": {"version": "2.0"}, "extensionsUsed": ["ROWLAND_light_probe"], "nodes": [
            {"name": "a", "extensions": {"ROWLAND_light_probe": {"size_m": [4, 3, 5], "fade_m": 0.5, "probe": "a.probe"}}},
            {"name": "b", "translation": [6, 0, 0], "extensions": {"ROWLAND_light_probe": )" +
                                      probe + "}}]}");
    }
    std::vector<std::byte> cooked(const std::filesystem::path& source) {
        cook::Context context(source);
        return registry_.find("scene")->cook(context);
    }

    cook::Registry registry_;
};

constexpr const char* kSecondProbe = R"({"size_m": [1, 1, 1], "probe": "b.probe"})";

TEST_F(ProbeScene, ACookedSceneHoldsTheProbesOfItsBoxes) {
    write_probe("a.probe", "light of a");
    write_probe("b.probe", "light of b");
    const std::filesystem::path source = write_scene(kSecondProbe);
    const std::vector<std::byte> payload = cooked(source);
    const ImportedScene scene = read_cooked_scene(payload, "room.scene", {});
    ASSERT_EQ(scene.probes.size(), 2U);
    EXPECT_EQ(scene.probes[0].size_m, glm::vec3(4.0F, 3.0F, 5.0F));
    EXPECT_EQ(scene.probes[0].fade_m, 0.5F);
    EXPECT_EQ(scene.probes[1].fade_m, 1.0F);
    EXPECT_EQ(scene.nodes[scene.probes[1].node].name, "b");
    EXPECT_EQ(*scene.probes[0].cooked, bytes_of("light of a"));
    EXPECT_EQ(*scene.probes[1].cooked, bytes_of("light of b"));
    EXPECT_THAT(registry_.find("scene")->describe(payload, "room.scene"),
                HasSubstr("probe: \"a\"\nfile: a.probe\nsize: 4 3 5\nfade: 0.5\nbytes: 10\n"));
}

TEST_F(ProbeScene, AUriNamesItsFileDecoded) {
    write_probe("a.probe", "light of a");
    write_probe("b c.probe", "light of b");
    const ImportedScene scene =
        read_cooked_scene(cooked(write_scene(R"({"size_m": [1, 1, 1], "probe": "b%20c.probe"})")), "room.scene", {});
    EXPECT_EQ(scene.probes.at(1).file, "b c.probe");  // which a capture writes
    EXPECT_EQ(*scene.probes[1].cooked, bytes_of("light of b"));
}

TEST_F(ProbeScene, AMissingProbeIsLeftOutAndADependency) {
    write_probe("a.probe", "light of a");
    const std::filesystem::path source = write_scene(kSecondProbe);
    cook::Context context(source);
    testing::internal::CaptureStderr();
    const ImportedScene scene = read_cooked_scene(registry_.find("scene")->cook(context), "room.scene", {});
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("b.probe: these boxes"));
    EXPECT_TRUE(scene.probes.at(0).cooked);
    EXPECT_FALSE(scene.probes.at(1).cooked);
    EXPECT_THAT(context.dependencies(), Contains(source.parent_path() / "b.probe"));
}

TEST_F(ProbeScene, ManyMissingProbesAreOneWarningAndAFlatBoxAnother) {
    std::string nodes;
    for (int i = 0; i < 1000; ++i)
        nodes += fmt::format(
            R"({}{{"scale": [1, {}, -1], "extensions": {{"ROWLAND_light_probe": {{"size_m": [1, 1, 1], "probe": "{}.probe"}}}}}})",
            i > 0 ? ", " : "", i == 7 ? 0 : 1, i);
    const std::filesystem::path source = write(
        "rooms.gltf",
        fmt::format(R"({{"asset": {{"version": "2.0"}}, "extensionsUsed": ["ROWLAND_light_probe"], "nodes": [{}]}})",
                    nodes));
    testing::internal::CaptureStderr();
    const ImportedScene scene = read_cooked_scene(cooked(source), "rooms.scene", {});
    const std::string warnings = testing::internal::GetCapturedStderr();
    EXPECT_EQ(scene.probes.size(), 1000U);
    EXPECT_THAT(warnings, HasSubstr("2.probe and 997 more"));
    EXPECT_EQ(std::ranges::count(warnings, '\n'), 1);
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("/nodes/7: the box has no volume")));
}

TEST_F(ProbeScene, WhatIsNoProbeIsRefused) {
    write_probe("a.probe", "dark");
    EXPECT_THAT(message_of([&] { cooked(write_scene(kSecondProbe)); }), HasSubstr("a.probe"));
    write_probe("a.probe", "light", 6);
    EXPECT_THAT(message_of([&] { cooked(write_scene(kSecondProbe)); }), HasSubstr("version"));
    write_probe("a.probe", "light");
    for (const char* probe :
         {R"({"size_m": [1, 1, 1]})", R"({"size_m": [1, 0, 1], "probe": "b.probe"})",
          R"({"size_m": [1, -2, 1], "probe": "b.probe"})", R"({"size_m": [1, 1], "probe": "b.probe"})",
          R"({"size_m": [1, 1, 1], "fade_m": -1, "probe": "b.probe"})",
          R"({"size_m": [1, 1, 1], "probe": "../b.probe"})", R"({"probe": 3})"}) {
        EXPECT_THAT(message_of([&] { cooked(write_scene(probe)); }), HasSubstr("nodes")) << probe;
    }
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

TEST_F(CookedScene, TakesTablesOfEarlierCooksOfTheSameParts) {
    int made = 0;
    cook::Registry registry;
    cook::GltfExtension extension = colour_extension();
    extension.part_key = [](const cook::SceneExtension& at) { return at.object.value("colour", ""); };
    extension.cook = [&made, make = extension.cook](cook::Context& context, const cook::SceneExtension& at) {
        ++made;
        return make(context, at);
    };
    registry.add_gltf_extension(extension);
    register_scene_type(registry);
    const auto makes = [&](const std::filesystem::path& source) {
        made = 0;
        cook::Context context(source, folder_.path() / "parts");
        const std::vector<std::byte> payload = registry.find(kSceneAssetType)->cook(context);
        EXPECT_EQ(payload, cook(source));  // without parts
        EXPECT_THAT(context.dependencies(), testing::ElementsAre(source, source.parent_path() / "shade.txt"));
        return made;
    };
    EXPECT_EQ(makes(scene_), 2);  // red and blue
    EXPECT_EQ(makes(scene_), 0);
    const std::filesystem::path other = folder_.path() / "elsewhere" / "t.gltf";
    write_file_atomic(other.parent_path() / "shade.txt", "dark ");
    write_file_atomic(other, R"({"asset": {"version": "2.0"}, "materials": [
        {"extensions": {"TEST_colour": {"colour": "green"}}}, {"extensions": {"TEST_colour": {"colour": "blue"}}}]})");
    EXPECT_EQ(makes(other), 1);
    write_file_atomic(folder_.path() / "shade.txt", "pale ");
    EXPECT_EQ(makes(scene_), 2);
    for (const auto& file : std::filesystem::directory_iterator(folder_.path() / "parts"))
        if (file.path().extension() == ".part") write_file_atomic(file.path(), "damaged");
    EXPECT_EQ(makes(scene_), 2);
    EXPECT_EQ(makes(scene_), 0);
    std::filesystem::remove(folder_.path() / "shade.txt");
    cook::Context refused(scene_, folder_.path() / "parts");
    EXPECT_THROW(registry.find(kSceneAssetType)->cook(refused), Error);
    EXPECT_THAT(refused.dependencies(), Contains(folder_.path() / "shade.txt"));
    write_file_atomic(folder_.path() / "shade.txt", "pale ");
    EXPECT_EQ(makes(scene_), 0);
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
