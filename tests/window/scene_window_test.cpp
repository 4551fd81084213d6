// An artist's scene in the inspector's window: chosen by a click, given a grating, its grooves turned, saved, and drawn
// by the demo.

#include <algorithm>
#include <sstream>

#include "engine/core/file.h"
#include "engine/image/byte_image.h"
#include "engine/scene/editable_gltf.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "tests/support/folder_test.h"
#include "tests/support/light.h"
#include "tests/window/inspector_user.h"

namespace rowland {
namespace {

using nlohmann::ordered_json;
using test::Facts;
using test::InspectorUser;

class SceneWindow : public test::FolderTest {
 protected:
    void SetUp() override {
        ROWLAND_NEEDS_VIRTUAL_DISPLAY();
        write_file_atomic(path("sky.json"), test::small_sky(128));
    }

    /// The demo's picture of a scene.
    std::vector<std::uint8_t> drawn(const std::filesystem::path& scene) const {
        const auto picture = path("picture.png");
        const test::Ended demo = test::run({ROWLAND_DEMO, "--headless", "--scene", scene, "--probe", path("sky.json"),
                                            "--width", kWidth, "--height", kWidth, "--capture", picture});
        EXPECT_EQ(demo.code, 0) << demo.err;
        return image::decode_byte_image(read_file(picture, 1 << 24), "picture").rgba;
    }

    /// Gives the material under a point of the preview a DVD's grating, turns its grooves, and saves. The saved file.
    static void edit(InspectorUser& user, glm::dvec2 at, const std::string& expected) {
        user.wait_for("busy", "no");
        user.pick(at);
        user.wait_for("chosen material", expected);
        user.click("attach");
        user.click("attach=dvd");
        user.wait_for("material", "740");
        if (!user.facts().contains("groove handle")) user.click("show grooves");
        user.drag("groove handle", {40, 25});
        user.wait_for("material", "grooveRotation");
        user.key("ctrl+s");
        user.wait_for("message", "saved");
    }

    /// Both files hold the same but for that material's grating.
    static void expect_only_grating(const std::filesystem::path& before, const std::filesystem::path& after,
                                    std::size_t material) {
        scene::EditableGltf saved = scene::EditableGltf::open(after);
        const ordered_json grating = saved.material_extension(material, diffraction::kGltfExtension);
        EXPECT_EQ(grating["grating"]["pitch_nm"], 740);
        EXPECT_NE(grating["grooveRotation"], 0.0);
        saved.set_material_extension(material, diffraction::kGltfExtension, nullptr);
        saved.save();
        // The same file with the white space of a saved one.
        const std::filesystem::path rewritten = after.parent_path() / ("rewritten" + after.extension().string());
        std::filesystem::copy_file(before, rewritten, std::filesystem::copy_options::overwrite_existing);
        scene::EditableGltf original = scene::EditableGltf::open(rewritten);
        original.set_material_extension(material, diffraction::kGltfExtension, nullptr);
        original.save();
        EXPECT_EQ(read_file(after, 1 << 26), read_file(rewritten, 1 << 26));
    }

    static constexpr const char* kWidth = "360";
    const std::string kLamps = test::content_path("probes/night.json").string();
};

TEST_F(SceneWindow, OneSampleOfManyGetsAGratingAlone) {
    ROWLAND_TEST_DATA(original, "gltf/valid/ClearCoatTest/ClearCoatTest.gltf");
    std::filesystem::copy(original.parent_path(), path("scene"));
    const std::filesystem::path scene = path("scene/ClearCoatTest.gltf");
    const std::vector<std::uint8_t> before = drawn(scene);
    {
        InspectorUser user(folder_.path(), {scene, "--probe", path("sky.json")});
        user.wait_for("document", "ClearCoatTest.gltf");
        // That sphere is 0.265 half heights of the picture to the right of the middle.
        std::istringstream picture(user.facts().at("picture"));
        glm::dvec2 least;
        glm::dvec2 most;
        picture >> least.x >> least.y >> most.x >> most.y;
        const double aspect = (most.x - least.x) / (most.y - least.y);
        edit(user, {0.5 + 0.5 * 0.265 / aspect, 0.42}, "RoughVariations_Coated");
        EXPECT_EQ(user.leave(), 0);
    }
    const std::vector<std::uint8_t> after = drawn(scene);
    // Only pixels of that sample differ, which is 47 wide.
    std::size_t changed = 0;
    for (std::size_t i = 0; i < before.size(); i += 4)
        changed += std::equal(&before[i], &before[i] + 3, &after[i]) ? 0U : 1U;
    EXPECT_GT(changed, 750U);
    EXPECT_LE(changed, 49U * 49U);
    expect_only_grating(original, scene, 7);
}

TEST_F(SceneWindow, ADracoModelAndAGlbAreSavedLikewise) {
    ROWLAND_TEST_DATA(draco, "gltf/draco/derived/Duck_draco_default.glb");
    ROWLAND_TEST_DATA(binary, "gltf/valid/Duck/glTF_Binary/Duck.glb");
    for (const std::filesystem::path& original : {draco, binary})
        std::filesystem::copy_file(original, path(original.filename()));
    {
        InspectorUser user(folder_.path(), {path(draco.filename()), "--probe", path("sky.json")});
        edit(user, {0.5, 0.5}, "blinn3-fx");
        user.drop(path(binary.filename()));
        user.wait_for("document", binary.filename());
        edit(user, {0.5, 0.5}, "blinn3-fx");
        EXPECT_EQ(user.leave(), 0);
    }
    for (const std::filesystem::path& original : {draco, binary})
        expect_only_grating(original, path(original.filename()), 0);
}

}  // namespace
}  // namespace rowland
