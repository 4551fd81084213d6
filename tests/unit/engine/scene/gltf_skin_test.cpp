#include "engine/scene/gltf_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/engine/scene/hand_written_gltf.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

using nlohmann::json;
using test::error_of;
using test::load;
using testing::HasSubstr;

std::vector<float> inverse_binds() {
    std::vector<float> values(32, 0.0F);
    for (const std::size_t matrix : {0U, 16U})
        for (std::size_t i = 0; i < 4; ++i) values[matrix + 5 * i] = 1.0F;
    values[16 + 13] = -1.0F;  // the second joint stands at y = 1
    return values;
}

/// Five vertices, the first four of joint 0, the last of joint 1, which its node has moved by 3 along X.
json skinned() {
    json file = test::document(5);
    const std::vector<std::uint8_t> joints = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0};
    std::vector<float> weights(20, 0.0F);
    for (std::size_t i = 0; i < weights.size(); i += 4) weights[i] = 1.0F;
    test::set_attribute(file, "JOINTS_0", test::add_accessor(file, "VEC4", 5121, 5, std::as_bytes(std::span(joints))));
    test::set_attribute(file, "WEIGHTS_0", test::add_floats(file, "VEC4", weights));
    file["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                     {{"children", {2}}, {"name", "root"}},
                     {{"translation", {3, 1, 0}}, {"name", "tip"}}};
    file["scenes"][0]["nodes"] = {0, 1};
    file["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", test::add_floats(file, "MAT4", inverse_binds())}}};
    return file;
}

TEST(GltfSkin, JointsAndBindMatricesAreRead) {
    const ImportedScene scene = load(skinned());
    EXPECT_TRUE(test::is_sane(scene));
    ASSERT_EQ(scene.skins.size(), 1U);
    ASSERT_THAT(scene.skins[0].joints, testing::SizeIs(2));
    EXPECT_EQ(scene.nodes.at(scene.skins[0].joints[0]).name, "root");
    EXPECT_EQ(scene.nodes.at(scene.skins[0].joints[1]).name, "tip");
    EXPECT_EQ(scene.nodes.at(scene.skins[0].joints[1]).parent, scene.skins[0].joints[0]);
    EXPECT_EQ(scene.skins[0].inverse_bind[1][3], glm::vec4(0.0F, -1.0F, 0.0F, 1.0F));
    EXPECT_EQ(scene.instances.at(0).skin, 0U);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfSkin, PosedAtRestItIsAMeshOfTheSamePlace) {
    ImportedScene scene = load(skinned());
    const Mesh merged = merge_instances(scene);
    pose_skins_at_rest(scene);
    EXPECT_TRUE(scene.skins.empty());
    EXPECT_FALSE(scene.instances.at(0).skin);
    EXPECT_EQ(scene.nodes.at(scene.instances.at(0).node).world, glm::mat4(1.0F));
    EXPECT_EQ(merge_instances(scene).positions, merged.positions);
    EXPECT_EQ(scene.tangents.size(), scene.meshes.size());
    EXPECT_EQ(scene.primitives.size(), scene.meshes.size());
}

TEST(GltfSkin, MergedSkinIsPlacedByItsJointsNotItsNode) {
    const Mesh merged = merge_instances(load(skinned()));
    EXPECT_EQ(merged.positions.at(1), glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_EQ(merged.positions.at(4), glm::vec3(3.0F, 2.0F, 0.0F));
}

TEST(GltfSkin, WithoutBindMatricesTheyAreIdentities) {
    json file = skinned();
    file["skins"][0].erase("inverseBindMatrices");
    EXPECT_EQ(load(file).skins.at(0).inverse_bind.at(1), glm::mat4(1.0F));
}

TEST(GltfSkin, BadSkinsAreRefused) {
    const auto with = [](const std::string& key, const json& value) {
        json file = skinned();
        file["skins"][0][key] = value;
        return error_of(file);
    };
    EXPECT_EQ(with("skeleton", 1), "no error");
    EXPECT_THAT(with("joints", {1, 3}), HasSubstr("/skins/0/joints: 3"));
    EXPECT_THAT(with("joints", {1, -1}), HasSubstr("/skins/0/joints"));
    EXPECT_THAT(with("joints", json::array()), HasSubstr("/skins/0/joints: 0 joints"));
    EXPECT_THAT(with("joints", {1}), HasSubstr("a vertex with joint 1"));
    EXPECT_THAT(with("joints", {1, 2, 1}), HasSubstr("2 inverse bind matrices"));
    EXPECT_THAT(with("joints", 7), HasSubstr("/skins/0/joints"));
    EXPECT_THAT(with("skeleton", 9), HasSubstr("/skins/0/skeleton"));
    EXPECT_THAT(with("inverseBindMatrices", 99), HasSubstr("/skins/0/inverseBindMatrices"));
    EXPECT_THAT(with("inverseBindMatrices", 0), HasSubstr("4 x 4 matrices of floats"));
}

TEST(GltfSkin, JointOutsideTheSceneIsRefused) {
    json file = skinned();
    file["scenes"][0]["nodes"] = {0};
    EXPECT_THAT(error_of(file), HasSubstr("/skins/0/joints: joint 1 outside the scene"));
    // A skin that nothing shown uses does no harm.
    file["nodes"][0].erase("skin");
    EXPECT_TRUE(load(file).skins.empty());
}

TEST(GltfSkin, NodeNamesAnExistingSkin) {
    json file = skinned();
    file["nodes"][0]["skin"] = 1;
    EXPECT_THAT(error_of(file), HasSubstr("/nodes/0/skin"));
    file["nodes"][0]["skin"] = -1;
    EXPECT_THAT(error_of(file), HasSubstr("/nodes/0/skin"));
}

TEST(GltfSkin, SkeletonThatIsACycleIsRefused) {
    json file = skinned();
    file["nodes"][2]["children"] = {1};
    EXPECT_THAT(error_of(file), HasSubstr("its own descendant"));
}

TEST(GltfSkin, MeshMayBeItsOwnJoint) {
    json file = skinned();
    file["skins"][0]["joints"] = {0, 2};
    EXPECT_TRUE(test::is_sane(load(file)));
}

TEST(GltfSkin, BindMatricesThatAreNotNumbersAreRefused) {
    json file = skinned();
    std::vector<float> values = inverse_binds();
    values[3] = std::numeric_limits<float>::quiet_NaN();  // in the bottom row, which is not read
    file["skins"][0]["inverseBindMatrices"] = test::add_floats(file, "MAT4", values);
    EXPECT_EQ(error_of(file), "no error");
    values[20] = std::numeric_limits<float>::infinity();
    file["skins"][0]["inverseBindMatrices"] = test::add_floats(file, "MAT4", values);
    EXPECT_THAT(error_of(file), HasSubstr("infinite or not a number"));
}

TEST(GltfSkin, MeshWithoutJointsIgnoresASkin) {
    json file = skinned();
    file["meshes"][0]["primitives"][0]["attributes"].erase("JOINTS_0");
    const ImportedScene scene = load(file);
    EXPECT_FALSE(scene.instances.at(0).skin);
    EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("weights without joints"),
                                                     HasSubstr("a skin of a mesh whose vertices have no joints")));
}

}  // namespace
}  // namespace rowland::scene
