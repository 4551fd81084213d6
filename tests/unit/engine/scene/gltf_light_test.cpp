#include "engine/scene/gltf_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland::scene {
namespace {

using nlohmann::json;
using test::error_of;
using test::load;
using testing::HasSubstr;

/// A file with one light, at node 0 (which stands at x = 2).
json lit(const json& light) {
    json file = test::document(5);
    file["extensionsUsed"] = {"KHR_lights_punctual"};
    file["extensionsRequired"] = {"KHR_lights_punctual"};
    file["extensions"]["KHR_lights_punctual"]["lights"] = json::array({light});
    file["nodes"][0]["translation"] = {2, 0, 0};
    file["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    return file;
}

template <typename Light>
Light only_light(const ImportedScene& scene) {
    EXPECT_EQ(scene.lights.size(), 1U);
    return std::get<Light>(scene.lights.at(0).light);
}

TEST(GltfLight, DirectionalLightShinesAlongItsNodesMinusZ) {
    const ImportedScene scene = load(lit({{"type", "directional"}, {"color", {1.0, 0.5, 0.25}}, {"intensity", 4.0}}));
    EXPECT_EQ(scene.lights.at(0).node, 0U);
    const auto light = only_light<DirectionalLight>(scene);
    EXPECT_EQ(light.direction, glm::vec3(0.0F, 0.0F, 1.0F));
    EXPECT_EQ(light.irradiance, glm::vec3(4.0F, 2.0F, 1.0F));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfLight, PointLightHasItsRange) {
    const auto light = only_light<PunctualLight>(load(lit({{"type", "point"}, {"intensity", 3.0}, {"range", 5.0}})));
    EXPECT_EQ(light.intensity, glm::vec3(3.0F));
    EXPECT_EQ(light.range_m, 5.0F);
    EXPECT_FALSE(light.spot);
    EXPECT_EQ(only_light<PunctualLight>(load(lit({{"type", "point"}}))).range_m, 0.0F);
}

TEST(GltfLight, SpotHasItsCones) {
    const auto light = only_light<PunctualLight>(
        load(lit({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}})));
    EXPECT_TRUE(light.spot);
    EXPECT_EQ(light.inner_cone, 0.25F);
    EXPECT_EQ(light.outer_cone, 0.5F);
    const auto plain = only_light<PunctualLight>(load(lit({{"type", "spot"}, {"spot", json::object()}})));
    EXPECT_EQ(plain.inner_cone, 0.0F);
    EXPECT_FLOAT_EQ(plain.outer_cone, 0.785398163F);
}

TEST(GltfLight, BadLightsAreRefused) {
    const auto spot = [](double inner, double outer) {
        return error_of(lit({{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}}));
    };
    EXPECT_EQ(spot(0.0, 1.5707963267948966), "no error");
    EXPECT_THAT(spot(0.5, 0.5), HasSubstr("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle"));
    EXPECT_THAT(spot(-0.1, 0.5), HasSubstr("innerConeAngle"));
    EXPECT_THAT(spot(0.1, 2.0), HasSubstr("outerConeAngle"));
    EXPECT_THAT(error_of(lit({{"type", "spot"}, {"spot", {{"innerConeAngle", 1.0}}}})), HasSubstr("outerConeAngle"));
    EXPECT_THAT(error_of(lit({{"type", "spot"}})), HasSubstr("lights/0/spot"));
    EXPECT_THAT(error_of(lit({{"type", "area"}})), HasSubstr("lights/0/type"));
    EXPECT_THAT(error_of(lit({{"type", "point"}, {"range", 0.0}})), HasSubstr("lights/0/range"));
    EXPECT_THAT(error_of(lit({{"type", "point"}, {"intensity", -1.0}})), HasSubstr("lights/0/intensity"));
    EXPECT_THAT(error_of(lit({{"type", "point"}, {"color", {1.0, 1.0}}})), HasSubstr("lights/0/color"));
    json file = lit({{"type", "point"}});
    file["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 1;
    EXPECT_THAT(error_of(file), HasSubstr("/nodes/0/extensions/KHR_lights_punctual/light"));
    file.erase("extensions");
    EXPECT_THAT(error_of(file), HasSubstr("the file has no lights"));
}

TEST(GltfLight, LightsOfHiddenNodesAreLeftOut) {
    json file = lit({{"type", "point"}});
    file["scenes"][0]["nodes"] = json::array();
    EXPECT_TRUE(load(file).lights.empty());
}

}  // namespace
}  // namespace rowland::scene
