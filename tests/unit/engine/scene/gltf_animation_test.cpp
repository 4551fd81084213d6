// Animations and skins of glTF files.
#include <gmock/gmock.h>

#include <limits>

#include "tests/unit/engine/scene/hand_written_gltf.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

using nlohmann::json;
using test::error_of;
using test::load;
using testing::HasSubstr;

/// One channel that moves node 0 as the accessors say.
json animated(const std::string& path, const std::vector<float>& times, const std::string& type,
              const std::vector<float>& values, const std::string& interpolation = "LINEAR") {
    json file = test::document(5);
    const std::size_t input = test::add_floats(file, "SCALAR", times);
    const std::size_t output = test::add_floats(file, type, values);
    file["animations"] = {{{"name", "moves"},
                           {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
                           {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
    return file;
}

json moved() {
    return animated("translation", {0.5F, 2.0F}, "VEC3", {0, 0, 0, 1, 2, 3});
}

TEST(GltfAnimation, ChannelIsReadWithItsKeys) {
    const ImportedScene scene = load(moved());
    EXPECT_TRUE(test::is_sane(scene));
    ASSERT_EQ(scene.animations.size(), 1U);
    const Animation& animation = scene.animations[0];
    EXPECT_EQ(animation.name, "moves");
    EXPECT_EQ(animation.duration_s, 2.0F);
    ASSERT_EQ(animation.channels.size(), 1U);
    EXPECT_EQ(animation.channels[0].node, 0U);
    EXPECT_EQ(animation.channels[0].property, AnimatedProperty::Translation);
    EXPECT_EQ(animation.channels[0].interpolation, Interpolation::Linear);
    EXPECT_THAT(animation.channels[0].times_s, testing::ElementsAre(0.5F, 2.0F));
    EXPECT_EQ(animation.channels[0].values.at(1), glm::vec4(1.0F, 2.0F, 3.0F, 0.0F));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfAnimation, InterpolationIsRead) {
    const auto read = [](const std::string& name, const std::vector<float>& values) {
        return load(animated("scale", {0.0F, 1.0F}, "VEC3", values, name))
            .animations.at(0)
            .channels.at(0)
            .interpolation;
    };
    EXPECT_EQ(read("STEP", std::vector<float>(6, 1.0F)), Interpolation::Step);
    EXPECT_EQ(read("CUBICSPLINE", std::vector<float>(18, 1.0F)), Interpolation::CubicSpline);
    json file = moved();
    file["animations"][0]["samplers"][0].erase("interpolation");
    EXPECT_EQ(load(file).animations.at(0).channels.at(0).interpolation, Interpolation::Linear);
}

TEST(GltfAnimation, NormalisedIntegersAreRotations) {
    json file = animated("rotation", {0.0F}, "VEC4", {0, 0, 0, 1});
    const std::vector<std::int16_t> turn = {-32768, 0, 32767, 16384};
    file["animations"][0]["samplers"][0]["output"] =
        test::add_accessor(file, "VEC4", 5122, 1, std::as_bytes(std::span(turn)), true);
    const glm::vec4 value = load(file).animations.at(0).channels.at(0).values.at(0);
    EXPECT_EQ(value, glm::vec4(-1.0F, 0.0F, 1.0F, 16384.0F / 32767.0F));
    file["accessors"].back()["normalized"] = false;
    EXPECT_THAT(error_of(file), HasSubstr("/animations/0/samplers/0: values of another type"));
}

TEST(GltfAnimation, BadKeysAreRefused) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::vector<float> two(6, 1.0F);
    EXPECT_THAT(error_of(animated("scale", {0.0F, kNan}, "VEC3", two)), HasSubstr("time nan of key 1"));
    EXPECT_THAT(error_of(animated("scale", {kNan, 1.0F}, "VEC3", two)), HasSubstr("time nan of key 0"));
    EXPECT_THAT(error_of(animated("scale", {0.0F, kInfinity}, "VEC3", two)), HasSubstr("of key 1"));
    EXPECT_THAT(error_of(animated("scale", {1.0F, 1.0F}, "VEC3", two)), HasSubstr("each later than the one before"));
    EXPECT_THAT(error_of(animated("scale", {0.0F}, "VEC3", two)), HasSubstr("2 values for 1 keys"));
    EXPECT_THAT(error_of(animated("scale", {0.0F, 1.0F}, "VEC3", two, "CUBICSPLINE")), HasSubstr("expected 6"));
    EXPECT_THAT(error_of(animated("scale", {0.0F, 1.0F}, "VEC3", {1, 1, 1, kInfinity, 1, 1})),
                HasSubstr("infinite or not a number"));
    EXPECT_THAT(error_of(animated("scale", {0.0F}, "VEC4", {1, 1, 1, 1})), HasSubstr("values of another type"));
    EXPECT_THAT(error_of(animated("rotation", {0.0F, 1.0F}, "VEC3", two)), HasSubstr("values of another type"));
    EXPECT_THAT(error_of(animated("scale", {0.0F, 1.0F}, "VEC3", two, "SMOOTH")),
                HasSubstr("/animations/0/samplers/0/interpolation"));
}

TEST(GltfAnimation, IndicesAreChecked) {
    const auto with = [](const std::string& pointer, const json& value) {
        json file = moved();
        file[json::json_pointer("/animations/0" + pointer)] = value;
        return error_of(file);
    };
    EXPECT_THAT(with("/samplers/0/input", 9), HasSubstr("/animations/0/samplers/0/input"));
    EXPECT_THAT(with("/samplers/0/output", -1), HasSubstr("/animations/0/samplers/0/output"));
    EXPECT_THAT(with("/samplers/0/input", 2), HasSubstr("scalars of floats"));
    EXPECT_THAT(with("/channels/0/sampler", 1), HasSubstr("/animations/0/channels/0/sampler"));
    EXPECT_THAT(with("/channels/0/target/node", 5), HasSubstr("/animations/0/channels/0/target/node"));
    EXPECT_THAT(with("/channels/0/target", 5), HasSubstr("/animations/0/channels/0/target"));
    EXPECT_THAT(with("/samplers", json::array()), HasSubstr("the animation has no samplers"));
    EXPECT_THAT(with("/channels", 3), HasSubstr("/animations/0/channels"));
    EXPECT_THAT(with("/name", 3), HasSubstr("/animations/0/name"));
}

TEST(GltfAnimation, WeightsAreIgnoredWithOneWarning) {
    json file = moved();
    file["animations"][0]["channels"][0]["target"]["path"] = "weights";
    file["animations"][0]["channels"].push_back(file["animations"][0]["channels"][0]);
    const ImportedScene scene = load(file);
    EXPECT_TRUE(scene.animations.empty());
    EXPECT_THAT(scene.warnings, testing::ElementsAre("animation of weights is ignored"));
}

TEST(GltfAnimation, ChannelsOfNodesThatAreNotShownAreIgnored) {
    json file = moved();
    file["nodes"].push_back({{"name", "elsewhere"}});
    file["animations"][0]["channels"][0]["target"]["node"] = 1;
    EXPECT_TRUE(load(file).animations.empty());
    file["animations"][0]["channels"][0]["target"].erase("node");
    EXPECT_TRUE(load(file).animations.empty());
}

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
