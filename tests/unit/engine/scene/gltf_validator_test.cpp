// Khronos' own validator on what we write.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/scene/editable_gltf.h"
#include "engine/scene/mesh_recipe.h"
#include "engine/scene/scene_recipe.h"
#include "tests/support/source_tree.h"
#include "tests/support/temporary_folder.h"

namespace rowland::scene {
namespace {

constexpr int kNoValidator = 77;     ///< validate_gltf.cjs found none
constexpr int kNoSuchCommand = 127;  ///< the shell found no node

int validate(const std::vector<std::byte>& bytes) {
    const rowland::test::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "scene.glb";
    write_file_atomic(file, bytes);
    const std::string command = "node '" ROWLAND_GLTF_VALIDATOR_SCRIPT "' '" + file.string() + "'";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::vector<std::byte> golden_image() {
    return read_file(rowland::test::source_path("tests/golden/images/cd_studio.png"), 1 << 24);
}

TEST(GltfValidator, FindsNothingWrongWithTheShippedScene) {
    const std::string path = rowland::test::content_path("scenes/cabinet.json").string();
    const SceneRecipe recipe = parse_scene_recipe(parse_json(read_text_file(path, 1 << 20), path), path);
    const int status = validate(write_glb(build_scene(recipe)));
    if (status == kNoValidator || status == kNoSuchCommand)
        GTEST_SKIP() << "node or its module gltf-validator is missing";
    EXPECT_EQ(status, 0);
}

TEST(GltfValidator, FindsNothingWrongWithAnEditedScene) {
    GlbScene scene;
    scene.materials.push_back({.name = "gold", .colour_texture = {}});
    const Mesh mesh = build_mesh(PlaneRecipe{.width = 1.0, .depth = 1.0, .subdivisions = 3});
    scene.meshes.push_back({"pair", {{mesh, 0}, {mesh, 0}, {mesh, std::nullopt}}});
    scene.nodes.emplace_back().mesh = 0;
    EditableGltf edited(write_glb(scene), "scene.glb");
    for (const PrimitiveId primitive : {PrimitiveId{0, 1}, PrimitiveId{0, 2}})
        edited.set_material_extension(edited.own_material(primitive), "TEST_grooves",
                                      {{"texture",
                                        {{"index", edited.add_texture(golden_image(), "grooves", {{"wrapS", 33071}})},
                                         {"extensions", {{"KHR_texture_transform", {{"rotation", 1}}}}}}}});
    EXPECT_EQ(edited.outline().materials.size(), 3U);
    const int status = validate(edited.bytes());
    if (status == kNoValidator || status == kNoSuchCommand)
        GTEST_SKIP() << "node or its module gltf-validator is missing";
    EXPECT_EQ(status, 0);
}

TEST(GltfValidator, FindsAFaultThatWeMade) {
    GlbScene scene;
    scene.materials.push_back({.name = "too rough", .roughness = 2.0, .colour_texture = {}});
    const int status = validate(write_glb(scene));
    if (status == kNoValidator || status == kNoSuchCommand)
        GTEST_SKIP() << "node or its module gltf-validator is missing";
    EXPECT_EQ(status, 1);
}

}  // namespace
}  // namespace rowland::scene
