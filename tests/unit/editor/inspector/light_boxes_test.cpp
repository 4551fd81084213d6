#include "editor/inspector/light_boxes.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "engine/core/file.h"
#include "tests/support/expect.h"
#include "tests/support/folder_test.h"

namespace rowland::inspector {
namespace {

using testing::HasSubstr;

class LightBoxes : public test::FolderTest {
 protected:
    LightBoxes() { write_file_atomic(path("scene.gltf"), std::string_view(R"({"asset": {"version": "2.0"}})")); }
    Document opened() const { return Document::open_scene(scene::EditableGltf::open(path("scene.gltf"))); }
    Json saved() const { return Json::parse(read_text_file(path("scene.gltf"), 1 << 20)); }
};

TEST_F(LightBoxes, AreAddedMovedTakenBackAndSaved) {
    Document document = opened();
    EXPECT_TRUE(document.boxes().empty());
    const SceneObject scene{.file = {},
                            .imported = {},
                            .meshes = {},
                            .materials = {},
                            .without_material = {},
                            .bounds = {{-1.0F, 0.0F, 2.0F}, {3.0F, 2.0F, 2.0F}},
                            .fit = {}};
    std::vector<scene::ExtendedNode> boxes{new_light_box(document, scene)};
    EXPECT_EQ(boxes[0].translation, glm::dvec3(1.0, 1.0, 2.0));
    EXPECT_EQ(boxes[0].extension,
              Json::parse(R"({"size_m": [4.0, 2.0, 0.01], "fade_m": 1.0, "probe": "scene_light/box_1.probe"})"));
    document.set_boxes(boxes);
    document.finish_edit();
    EXPECT_EQ(new_light_box(document, scene).extension["probe"], "scene_light/box_2.probe");
    for (const double x : {1.5, 2.0}) {
        boxes[0].translation.x = x;
        document.set_boxes(boxes);
    }
    document.undo();
    EXPECT_EQ(document.boxes()[0].translation.x, 1.0) << "a drag is one step";
    document.redo();
    EXPECT_TRUE(document.dirty());
    boxes[0].extension["probe"] = "../elsewhere.probe";
    EXPECT_THAT(test::message_of([&] { document.set_boxes(boxes); }), HasSubstr("outside the glTF's folder"));
    document.save();
    EXPECT_FALSE(document.dirty());
    EXPECT_EQ(saved()["nodes"], Json::parse(R"([{"name": "box 1", "translation": [2.0, 1.0, 2.0],
        "rotation": [0.0, 0.0, 0.0, 1.0], "extensions": {"ROWLAND_light_probe":
            {"size_m": [4.0, 2.0, 0.01], "fade_m": 1.0, "probe": "scene_light/box_1.probe"}}}])"));
    EXPECT_EQ(opened().boxes(), document.boxes());
    document.set_boxes({});
    EXPECT_TRUE(document.dirty());
    document.undo();
    EXPECT_FALSE(document.dirty());
}

TEST(LightBox, ItsCornersLieWhereTheFileHasThem) {
    scene::ExtendedNode box{.index = 7, .translation = {1.0, 0.0, 0.0}, .scale = {1.0, 1.0, 2.0}};
    box.rotation = glm::angleAxis(std::numbers::pi / 2.0, glm::dvec3(0.0, 1.0, 0.0));
    box.extension = Json::parse(R"({"size_m": [2, 4, 6]})");
    SceneObject scene{
        .file = {}, .imported = {}, .meshes = {}, .materials = {}, .without_material = {}, .bounds = {}, .fit = {}};
    const auto corner = [&] { return glm::vec3(box_to_scene(box, scene) * glm::vec4(0.5F, 0.5F, 0.5F, 1.0F)); };
    // Its depth of 12 m lies along x, its width along −z.
    EXPECT_LT(glm::distance(corner(), glm::vec3(7.0F, 2.0F, -1.0F)), 1e-5F);
    scene.imported.nodes.resize(2);
    scene.imported.nodes[0].world = glm::translate(glm::mat4(1.0F), glm::vec3(0.0F, 10.0F, 0.0F));
    scene.imported.nodes[1].parent = 0;
    scene::ImportedProbe& probe = scene.imported.probes.emplace_back();
    probe.node = 1;
    probe.gltf_node = 7;
    EXPECT_LT(glm::distance(corner(), glm::vec3(7.0F, 12.0F, -1.0F)), 1e-5F) << "below its parent";
}

}  // namespace
}  // namespace rowland::inspector
