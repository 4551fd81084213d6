#include <gmock/gmock.h>

#include <algorithm>

#include "engine/scene/editable_gltf.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = "ROWLAND_materials_diffraction";
constexpr int kNoSuchProgram = 127;  ///< of env and of the dynamic linker
constexpr int kNoValidator = 77;     ///< of validate_gltf.cjs

/// The extension's object of the material called `name`.
nlohmann::ordered_json object_of(const fs::path& file, const std::string& name) {
    const scene::EditableGltf gltf = scene::EditableGltf::open(file);
    const std::vector<std::string>& names = gltf.outline().materials;
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw std::runtime_error(name + " is no material of " + file.string());
    return gltf.material_extension(static_cast<std::size_t>(found - names.begin()), kExtension);
}

/// Why Blender cannot be started; empty: it can.
std::string blender_is_missing() {
    const test::Ended version = test::run({"/usr/bin/env", "blender", "--version"});
    return version.code == kNoSuchProgram ? "Blender cannot be started: " + version.err : "";
}

/// Runs a script of this folder in Blender with the add-on; the folder holds Blender's settings, and is its first
/// argument.
test::Ended run_in_blender(const std::string& script, const fs::path& folder, const test::Command& more = {}) {
    fs::create_directories(folder / "scripts/addons");
    fs::create_directory_symlink(test::content_path("blender/rowland_diffraction"),
                                 folder / "scripts/addons/rowland_diffraction");
    test::Command command = {"/usr/bin/env",
                             "blender",
                             "-b",
                             "--factory-startup",
                             "--python-exit-code",
                             "3",
                             "--python",
                             test::source_path("tests/blender/" + script),
                             "--",
                             folder};
    command.insert(command.end(), more.begin(), more.end());
    return test::run(command, {.environment = {{"BLENDER_USER_SCRIPTS", (folder / "scripts").string()},
                                               {"HOME", folder.string()},
                                               {"PYTHONDONTWRITEBYTECODE", "1"}}});
}

TEST(BlenderAddOn, GratingsSurviveExportAndImportAndAreWhatAttachMakes) {
    if (const std::string missing = blender_is_missing(); !missing.empty()) {
        if (test::data_is_required()) FAIL() << missing;
        GTEST_SKIP() << missing;
    }
    const test::TemporaryFolder folder;
    const auto path = [&](const std::string& name) { return folder.path() / name; };
    const test::Ended blender = run_in_blender("round_trip.py", folder.path());
    ASSERT_EQ(blender.code, 0) << blender.out << blender.err;

    const test::Ended checked = test::run(
        {ROWLAND_COOK, "check", path("scene.glb"), path("scene.gltf"), path("again.glb"), path("screen.glb")});
    EXPECT_EQ(checked.code, 0) << checked.err;
    const test::Ended valid = test::run(
        {"/usr/bin/env", "node", test::source_path("tests/unit/engine/scene/validate_gltf.cjs"), path("scene.glb")});
    if (valid.code != kNoValidator && valid.code != kNoSuchProgram) {
        EXPECT_EQ(valid.code, 0) << valid.out;
    }

    const auto preset = [](const std::string& name) { return test::content_path("materials/" + name + ".json"); };
    ASSERT_EQ(test::run({ROWLAND_COOK, "attach", path("plain.glb"), "--material", "DVD", preset("dvd"), "--material",
                         "Vinyl", preset("vinyl")})
                  .code,
              0);
    for (const std::string name : {"DVD", "Vinyl", "Plain"})
        EXPECT_EQ(object_of(path("scene.glb"), name), object_of(path("plain.glb"), name)) << name;
    EXPECT_FALSE(object_of(path("scene.glb"), "DVD").is_null());
    for (const std::string name : {"DVD", "Vinyl", "Foil"})
        EXPECT_EQ(object_of(path("scene.glb"), name), object_of(path("scene.gltf"), name)) << name;
    const nlohmann::json boxes = nlohmann::json::parse(read_text_file(path("scene.gltf"), 1 << 20));
    EXPECT_THAT(boxes["extensionsUsed"], ::testing::Contains("ROWLAND_light_probe"));
    const auto has_box = [](const nlohmann::json& node) {
        return node.value("extensions", nlohmann::json::object()).contains("ROWLAND_light_probe");
    };
    const auto box = std::ranges::find_if(boxes["nodes"], has_box);
    ASSERT_NE(box, boxes["nodes"].end());
    EXPECT_EQ((*box)["extensions"]["ROWLAND_light_probe"],
              (nlohmann::json{{"size_m", {1.0, 1.0, 1.0}}, {"fade_m", 0.25}, {"probe", "rooms/Hall.probe"}}));
    EXPECT_NEAR((*box)["scale"][1].get<double>(), 3.0, 1e-6) << "glTF's Y is Blender's Z";
}

/// The bound is that of content/blender/README.md.
TEST(BlenderAddOn, ViewportColoursAreNearTheReference) {
    if (const std::string missing = blender_is_missing(); !missing.empty()) {
        if (test::data_is_required()) FAIL() << missing;
        GTEST_SKIP() << missing;
    }
    const test::TemporaryFolder folder;
    const test::Ended blender =
        run_in_blender("viewport_error.py", folder.path(), {test::content_path("materials/cd.json")});
    ASSERT_EQ(blender.code, 0) << blender.out << blender.err;
    const std::string before = "cd: relative RMS ";
    const std::size_t found = blender.out.find(before);
    ASSERT_NE(found, std::string::npos) << blender.out;
    const double percent = std::stod(blender.out.substr(found + before.size()));
    EXPECT_LE(percent, 20.0);
    EXPECT_GT(percent, 1.0) << "an approximation by bands, with the noise of 64 samples";
}

}  // namespace
}  // namespace rowland
