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
    EXPECT_THAT(error_of(file), HasSubstr("/animations/0/channels/0/sampler: values of another type"));
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

TEST(GltfAnimation, AccessorWithoutDataDoesNotAllocateItsCount) {
    json file = moved();
    const auto input = file["animations"][0]["samplers"][0]["input"].get<std::size_t>();
    file["accessors"][input] = {{"componentType", 5126}, {"count", 2000000000}, {"type", "SCALAR"}};
    EXPECT_THAT(error_of(file), HasSubstr("2000000000 elements of 4 bytes"));
}

TEST(GltfAnimation, ManyChannelsOfTheSameKeysDoNotMultiplyMemoryWithoutLimit) {
    std::vector<float> times(100'000);
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<float>(i);
    json file = animated("scale", times, "VEC3", std::vector<float>(3 * times.size(), 1.0F));
    const json channel = file["animations"][0]["channels"][0];
    for (int i = 0; i < 1000; ++i) file["animations"][0]["channels"].push_back(channel);
    EXPECT_THAT(error_of(file), HasSubstr("bytes in the whole scene"));
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

}  // namespace
}  // namespace rowland::scene
