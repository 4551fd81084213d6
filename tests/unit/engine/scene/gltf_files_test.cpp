// Files of real exporters and files made to break importers.

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> gltf_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// What loading says: empty if the file loads and is sane.
std::string refusal(const fs::path& path) {
    try {
        EXPECT_TRUE(test::is_sane(load_gltf(path))) << path;
        return {};
    } catch (const Error& error) {
        EXPECT_EQ(error.info().fault, Fault::Input) << path;
        EXPECT_THAT(error.what(), testing::StartsWith(path.string())) << "a refusal names the file";
        EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n"))) << "a refusal is one line";
        return error.what();
    }
}

TEST(GltfFiles, ValidFilesLoadSane) {
    ROWLAND_TEST_DATA(plain, "gltf/valid");
    ROWLAND_TEST_DATA(draco, "gltf/draco");
    for (const auto& [folder, at_least] : {std::pair(plain, 12U), {draco, 7U}}) {
        const std::vector<fs::path> files = gltf_files(folder);
        EXPECT_GE(files.size(), at_least);
        for (const fs::path& file : files) {
            EXPECT_EQ(refusal(file), "");
            EXPECT_FALSE(merge_instances(load_gltf(file)).indices.empty()) << file;
        }
    }
}

TEST(GltfFiles, DracoDuckEqualsPlainDuck) {
    ROWLAND_TEST_DATA(plain_path, "gltf/valid/Duck/glTF_Binary/Duck.glb");
    const Mesh plain = merge_instances(load_gltf(plain_path));
    const Bounds expected = bounds(plain);
    const glm::vec3 size = expected.maximum - expected.minimum;
    const float extent = std::max({size.x, size.y, size.z});
    struct Case {
        const char* file;
        int position_bits;
    };
    // The default and level 0 are quantised to 11 bits, q8 to 8.
    for (const Case& c :
         {Case{"Duck_draco_default.glb", 11}, {"Duck_draco_level0.glb", 11}, {"Duck_draco_q8_unified.glb", 8}}) {
        ROWLAND_TEST_DATA(path, std::string("gltf/draco/derived/") + c.file);
        const Mesh duck = merge_instances(load_gltf(path));
        EXPECT_EQ(duck.indices.size(), plain.indices.size()) << c.file;
        // Half a quantisation step, and a little for floats.
        const float tolerance = 0.51F * extent / static_cast<float>((1 << c.position_bits) - 1);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(bounds(duck).minimum[axis], expected.minimum[axis], tolerance) << c.file;
            EXPECT_NEAR(bounds(duck).maximum[axis], expected.maximum[axis], tolerance) << c.file;
        }
        EXPECT_NEAR(test::signed_volume(duck) / test::signed_volume(plain), 1.0, 0.01) << c.file;
    }
}

TEST(GltfFiles, TangentsOfTheFileAreKept) {
    ROWLAND_TEST_DATA(path, "gltf/valid/TwoSidedPlane/TwoSidedPlane.gltf");
    const ImportedScene scene = load_gltf(path);
    for (const glm::vec4& tangent : scene.meshes.at(0).tangents) EXPECT_EQ(tangent, glm::vec4(0.0F, 0.0F, -1.0F, 1.0F));
}

TEST(GltfFiles, MaterialFactorsAreRead) {
    ROWLAND_TEST_DATA(path, "gltf/valid/Box/glTF/Box.gltf");
    const ImportedScene scene = load_gltf(path);
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.materials[0].name, "Red");
    EXPECT_EQ(scene.materials[0].base_colour, glm::vec4(0.8F, 0.0F, 0.0F, 1.0F));
    EXPECT_EQ(scene.materials[0].metallic, 0.0F);
    EXPECT_EQ(scene.materials[0].roughness, 1.0F);
    EXPECT_EQ(scene.instances.at(0).material, 0U);
}

TEST(GltfFiles, DracoVertexColoursEqualThePlainOnes) {
    ROWLAND_TEST_DATA(plain_path, "gltf/valid/BoxVertexColors.glb");
    ROWLAND_TEST_DATA(draco_path, "gltf/draco/derived/BoxVertexColors_draco.glb");
    const Mesh plain = load_gltf(plain_path).meshes.at(0);
    const Mesh draco = load_gltf(draco_path).meshes.at(0);
    ASSERT_EQ(plain.colours.size(), 24U);
    ASSERT_EQ(draco.colours.size(), 24U);
    // The stream is quantised to 8 bits or more over an extent of 1: half a step, also for positions (a unit
    // box, 11 bits). Its vertices are in another order.
    constexpr float kHalfStep = 0.51F / 255.0F;
    std::size_t coloured = 0;
    for (std::size_t i = 0; i < 24; ++i) {
        const auto same = [&](std::size_t k) {
            return glm::distance(draco.positions[k], plain.positions[i]) < 0.01F &&
                   glm::dot(draco.normals[k], plain.normals[i]) > 0.99F;
        };
        std::size_t match = 0;
        while (match < 24 && !same(match)) ++match;
        ASSERT_LT(match, 24U);
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(draco.colours[match][c], plain.colours[i][c], kHalfStep);
        if (plain.colours[i] != plain.colours[0]) ++coloured;
    }
    EXPECT_GT(coloured, 0U) << "all of one colour would hide a mixed-up order";
}

TEST(GltfFiles, DracoSecondUvsAreRead) {
    ROWLAND_TEST_DATA(path, "gltf/draco/BoxMetaDraco/glTF/BoxMetaDraco.gltf");
    const ImportedScene scene = load_gltf(path);
    EXPECT_EQ(scene.meshes.at(0).uvs1.size(), 36U);
    EXPECT_THAT(scene.warnings, testing::ElementsAre("the extension EXT_mesh_features is ignored"));
}

TEST(GltfFiles, NoMalformedFileDoesHarm) {
    ROWLAND_TEST_DATA(folder, "gltf/malformed");
    const std::vector<fs::path> files = gltf_files(folder);
    EXPECT_GE(files.size(), 40U);
    for (const fs::path& file : files) {
        const auto start = std::chrono::steady_clock::now();
        refusal(file);
        // The largest takes milliseconds; a broken length must not turn that into a hang. Generous for sanitizers.
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2)) << file;
    }
}

TEST(GltfFiles, BrokenFilesAreRefusedWithWhereAndWhat) {
    ROWLAND_TEST_DATA(folder, "gltf/malformed");
    const std::pair<const char*, const char*> files[] = {
        {"assimp_BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", ""},
        {"assimp_IndexOutOfRange/AllIndicesOutOfRange.gltf", ""},
        {"assimp_IndexOutOfRange/IndexOutOfRange.gltf", "vertex index"},
        {"assimp_MissingBin/BoxTextured.gltf", "BoxTextured0.bin"},
        {"assimp_RecursiveNodes/RecursiveNodes.gltf", ""},
        {"assimp_wrongTypes/badArray.gltf", ""},
        {"assimp_wrongTypes/badExtension.gltf", ""},
        {"assimp_wrongTypes/badNumber.gltf", ""},
        {"assimp_wrongTypes/badObject.gltf", ""},
        {"assimp_wrongTypes/badString.gltf", ""},
        {"assimp_wrongTypes/badUint.gltf", ""},
        {"crash/depth_20000.glb", ""},
        {"crash/draco_acc99.glb", "/meshes/0/primitives/0/attributes/POSITION: 99"},
        {"crash/draco_bv99.glb", ""},
        {"crash/draco_idx99.glb", ""},
        {"crash/draco_noacc.glb", ""},
        {"crash/draco_nobv.glb", ""},
        {"crash/draco_swap_uid.glb", ""},
        {"crash/draco_uid77.glb", ""},
        {"crash/plain_acc_byteOffset_1000000000.glb", ""},
        {"crash/plain_acc_count_1099511627776.glb", ""},
        {"crash/plain_buf_len_small.glb", ""},
        {"crash/plain_bv_buffer_99.glb", "/bufferViews/0/buffer"},
        {"crash/plain_img_bvbadoff.glb", ""},
        {"crash/truncfix_plain_14363.glb", ""},
        {"draco_derived/bufferview_index_oob.glb", ""},
        {"draco_derived/glb_length_too_large.glb", ""},
        {"draco_derived/payload_all_zero.glb", ""},
        {"draco_derived/payload_truncated_half.glb", ""},
        {"draco_derived/unknown_required_extension.glb", "VENDOR_unknown_required"},
        {"tinygltf_regression/issue-416.gltf", ""},
    };
    for (const auto& [name, said] : files) {
        const std::string message = refusal(folder / name);
        EXPECT_NE(message, "") << name;
        EXPECT_THAT(message, testing::HasSubstr(said));
    }
}

TEST(GltfFiles, ReserialisedDracoBoxLoads) {
    ROWLAND_TEST_DATA(path, "gltf/malformed/draco_derived/box_ok_reserialised.glb");
    const Mesh box = merge_instances(load_gltf(path));
    EXPECT_EQ(box.positions.size(), 24U);
    EXPECT_EQ(box.indices.size(), 36U);
    // A unit cube, quantised to 11 bits or more.
    EXPECT_NEAR(test::signed_volume(box), 1.0, 3.0 / 2047.0);
}

TEST(GltfFiles, AccessorCountsThatDifferFromTheDracoStreamAreTolerated) {
    ROWLAND_TEST_DATA(path, "gltf/malformed/draco_derived/accessor_count_too_small.glb");
    EXPECT_EQ(merge_instances(load_gltf(path)).positions.size(), 24U);
}

}  // namespace
}  // namespace rowland::scene
