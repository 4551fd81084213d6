// Khronos' own validator on what we write.
#include <sys/wait.h>

#include "engine/core/file.h"
#include "engine/scene/editable_gltf.h"
#include "engine/scene/mesh_recipe.h"
#include "tests/support/files.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland::scene {
namespace {

constexpr int kNoValidator = 77;     ///< validate_gltf.cjs found none
constexpr int kNoSuchCommand = 127;  ///< the shell found no node

/// Expects the validator's exit status for a file's bytes; skips the test where there is no validator.
void expect_validity(const std::vector<std::byte>& bytes, int expected) {
    const rowland::test::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "scene.glb";
    write_file_atomic(file, bytes);
    const std::string command = "node '" ROWLAND_GLTF_VALIDATOR_SCRIPT "' '" + file.string() + "'";
    const int ended = std::system(command.c_str());
    const int status = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    if (status == kNoValidator || status == kNoSuchCommand)
        GTEST_SKIP() << "node or its module gltf-validator is missing";
    EXPECT_EQ(status, expected);
}

std::vector<std::byte> golden_image() {
    return read_file(rowland::test::source_path("tests/golden/images/cd_studio.png"), 1 << 24);
}

TEST(GltfValidator, FindsNothingWrongWithTheShippedScene) {
    expect_validity(read_file(rowland::test::content_path("scenes/cabinet.glb"), 1 << 24), 0);
}

TEST(GltfValidator, FindsNothingWrongWithAnEditedScene) {
    EditableGltf edited = EditableGltf::open(rowland::test::content_path("scenes/cabinet.glb"));
    const std::size_t meshes = edited.outline().meshes.size();
    const std::size_t materials = edited.outline().materials.size();
    for (std::size_t mesh = 0; mesh < meshes; ++mesh)
        edited.set_material_extension(edited.own_material({mesh, 0}), "TEST_grooves",
                                      {{"texture",
                                        {{"index", edited.add_texture(golden_image(), "grooves", {{"wrapS", 33071}})},
                                         {"extensions", {{"KHR_texture_transform", {{"rotation", 1}}}}}}}});
    EXPECT_GT(edited.outline().materials.size(), materials) << "some share a material";
    expect_validity(edited.bytes(), 0);
}

TEST(GltfValidator, FindsAFaultThatWeMade) {
    expect_validity(test::glb_of({{"asset", {{"version", "2.0"}}},
                                  {"materials", {{{"pbrMetallicRoughness", {{"roughnessFactor", 2}}}}}}}),
                    1);
}

}  // namespace
}  // namespace rowland::scene
