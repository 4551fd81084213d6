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

TEST(BlenderAddOn, GratingsSurviveExportAndImportAndAreWhatAttachMakes) {
    const test::Ended version = test::run({"/usr/bin/env", "blender", "--version"});
    if (version.code == kNoSuchProgram) {
        if (test::data_is_required()) FAIL() << "Blender cannot be started: " << version.err;
        GTEST_SKIP() << "Blender cannot be started: " << version.err;
    }
    const test::TemporaryFolder folder;
    const auto path = [&](const std::string& name) { return folder.path() / name; };
    fs::create_directories(path("scripts/addons"));
    fs::create_directory_symlink(test::content_path("blender/rowland_diffraction"),
                                 path("scripts/addons/rowland_diffraction"));
    const test::Ended blender =
        test::run({"/usr/bin/env", "blender", "-b", "--factory-startup", "--python-exit-code", "3", "--python",
                   test::source_path("tests/blender/round_trip.py"), "--", folder.path()},
                  {.environment = {{"BLENDER_USER_SCRIPTS", path("scripts").string()},
                                   {"HOME", folder.path().string()},
                                   {"PYTHONDONTWRITEBYTECODE", "1"}}});
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

}  // namespace
}  // namespace rowland
