#include "engine/scene/gltf_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland::scene {
namespace {

using nlohmann::json;
using test::load;

json with_extras(const json& extras) {
    json file = test::document(5);
    file["nodes"][0]["extras"] = extras;
    return file;
}

/// Whether the light of a node with these extras casts a shadow.
bool casts_shadow(const json& extras) {
    json file = with_extras(extras);
    file["extensionsUsed"] = {"KHR_lights_punctual"};
    file["extensions"]["KHR_lights_punctual"]["lights"] = json::array({{{"type", "directional"}}});
    file["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    return std::get<DirectionalLight>(load(file).lights.at(0).light).casts_shadow;
}

TEST(GltfExtras, ANodeKeepsItsExtrasAsTheyAre) {
    const json extras = {{"grab", true}, {"spin_axis", {0, 1, 0}}, {"deep", {{"er", nullptr}}}};
    EXPECT_EQ(load(with_extras(extras)).nodes.at(0).extras, extras);
    EXPECT_EQ(load(with_extras("just text")).nodes.at(0).extras, "just text");
    EXPECT_TRUE(load(test::document(5)).nodes.at(0).extras.is_null());
}

TEST(GltfExtras, LargeExtrasAreLeftOutWithAWarning) {
    const std::size_t quotes = 2;
    const ImportedScene fits = load(with_extras(std::string(kMostExtrasBytes - quotes, 'a')));
    EXPECT_TRUE(fits.nodes.at(0).extras.is_string());
    EXPECT_TRUE(fits.warnings.empty());
    const ImportedScene large = load(with_extras(std::string(kMostExtrasBytes - quotes + 1, 'a')));
    EXPECT_TRUE(large.nodes.at(0).extras.is_null());
    EXPECT_THAT(large.warnings, testing::ElementsAre(testing::HasSubstr("64 KiB")));
}

TEST(GltfExtras, ADirectionalLightCastsAShadowIfItsNodeSaysSo) {
    EXPECT_TRUE(casts_shadow({{"casts_shadow", true}}));
    EXPECT_FALSE(casts_shadow({{"casts_shadow", false}}));
    EXPECT_FALSE(casts_shadow(json::object()));
}

TEST(GltfExtras, WhatIsNotTrueCastsNoShadow) {
    for (const json& odd : {json(1), json("true"), json(nullptr), json::array({true})})
        EXPECT_FALSE(casts_shadow({{"casts_shadow", odd}})) << odd;
    for (const json& odd : {json(1), json("casts_shadow"), json::array({"casts_shadow"})})
        EXPECT_FALSE(casts_shadow(odd)) << odd;
}

}  // namespace
}  // namespace rowland::scene
