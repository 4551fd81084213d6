// Nodes of glTF files, their cameras and lights.
#include <gmock/gmock.h>

#include <limits>

#include "engine/scene/gltf_parts.h"
#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland::scene {
namespace {

using nlohmann::json;
using test::error_of;
using test::load;
using testing::HasSubstr;

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
    for (const json& odd : {json(1), json("true"), json(nullptr), json::array({true})})
        EXPECT_FALSE(casts_shadow({{"casts_shadow", odd}})) << odd;
    for (const json& odd : {json(1), json("casts_shadow"), json::array({"casts_shadow"})})
        EXPECT_FALSE(casts_shadow(odd)) << odd;
}

/// A file with one camera, at node 0.
json filmed(const json& camera) {
    json file = test::document(5);
    file["cameras"] = json::array({camera});
    file["nodes"][0]["camera"] = 0;
    return file;
}

json perspective(const json& lens) {
    return filmed({{"name", "lens"}, {"type", "perspective"}, {"perspective", lens}});
}

TEST(GltfCamera, PerspectiveCameraStandsAtItsNode) {
    const ImportedScene scene = load(perspective({{"yfov", 0.5}, {"znear", 0.25}, {"zfar", 8.0}, {"aspectRatio", 2}}));
    ASSERT_EQ(scene.cameras.size(), 1U);
    const ImportedCamera& camera = scene.cameras[0];
    EXPECT_EQ(camera.name, "lens");
    EXPECT_EQ(camera.node, 0U);
    EXPECT_EQ(camera.vertical_field_of_view, 0.5F);
    EXPECT_EQ(camera.near_plane, 0.25F);
    EXPECT_EQ(camera.far_plane, 8.0F);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfCamera, ACameraMaySeeToInfinity) {
    EXPECT_EQ(load(perspective({{"yfov", 0.5}, {"znear", 0.25}})).cameras.at(0).far_plane, std::nullopt);
}

TEST(GltfCamera, AnOrthographicCameraIsIgnoredWithAWarning) {
    const ImportedScene scene = load(filmed({{"type", "orthographic"}, {"orthographic", json::object()}}));
    EXPECT_TRUE(scene.cameras.empty());
    EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("orthographic")));
}

TEST(GltfCamera, CamerasAndLightsOfHiddenNodesAreLeftOut) {
    json file = perspective({{"yfov", 0.5}, {"znear", 0.25}});
    file["extensionsUsed"] = {"KHR_lights_punctual"};
    file["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    file["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    EXPECT_EQ(load(file).lights.size(), 1U);
    file["scenes"][0]["nodes"] = json::array();
    EXPECT_TRUE(load(file).cameras.empty());
    EXPECT_TRUE(load(file).lights.empty());
}

TEST(GltfCamera, BadLensesAreRefused) {
    const auto lens = [](const json& yfov, const json& znear, const json& zfar) {
        return error_of(perspective({{"yfov", yfov}, {"znear", znear}, {"zfar", zfar}}));
    };
    EXPECT_EQ(lens(0.5, 0.1, 10.0), "no error");
    const double nan = std::numeric_limits<double>::quiet_NaN();  // JSON has no such number; it is written as null
    for (const json& bad : {json(nan), json(0.0), json(-0.5), json(3.2), json("wide")})
        EXPECT_THAT(lens(bad, 0.1, 10.0), HasSubstr("/cameras/0/perspective/yfov")) << bad;
    for (const json& bad : {json(nan), json(0.0), json(-0.1), json(1e300), json(json::array())})
        EXPECT_THAT(lens(0.5, bad, 10.0), HasSubstr("/cameras/0/perspective/znear")) << bad;
    for (const json& bad : {json(nan), json(0.1), json(0.05), json(-1.0), json(1e300), json(0.1 + 1e-12)})
        EXPECT_THAT(lens(0.5, 0.1, bad), HasSubstr("/cameras/0/perspective/zfar")) << bad;
}

TEST(GltfCamera, IncompleteCamerasAreRefused) {
    EXPECT_THAT(error_of(perspective({{"znear", 0.1}})), HasSubstr("yfov"));
    EXPECT_THAT(error_of(perspective({{"yfov", 0.5}})), HasSubstr("znear"));
    EXPECT_THAT(error_of(filmed({{"type", "perspective"}})), HasSubstr("/cameras/0/perspective"));
    EXPECT_THAT(error_of(filmed({{"type", "fisheye"}})), HasSubstr("/cameras/0/type"));
    EXPECT_THAT(error_of(filmed(json::object())), HasSubstr("/cameras/0/type"));
    EXPECT_THAT(error_of(filmed(7)), HasSubstr("/cameras/0"));
}

TEST(GltfCamera, ANodesCameraMustBeOneOfTheFiles) {
    json file = perspective({{"yfov", 0.5}, {"znear", 0.1}});
    for (const json& bad : {json(1), json(-1), json(1e10), json("lens"), json(0.5)}) {
        file["nodes"][0]["camera"] = bad;
        EXPECT_THAT(error_of(file), HasSubstr("/nodes/0/camera")) << bad;
    }
    file["nodes"][0]["camera"] = 0;
    file.erase("cameras");
    EXPECT_THAT(error_of(file), HasSubstr("the file has no cameras"));
}

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

TEST(GltfLight, IsAsLargeAsItsNodesExtrasSay) {
    const auto sized = [](const char* type, const json& extras) {
        json file = lit({{"type", type}});
        if (!extras.is_null()) file["nodes"][0]["extras"] = extras;
        return file;
    };
    const auto angle = [&](const json& extras) {
        return only_light<DirectionalLight>(load(sized("directional", extras))).angular_radius;
    };
    const auto radius = [&](const json& extras) {
        return only_light<PunctualLight>(load(sized("point", extras))).radius_m;
    };
    EXPECT_FLOAT_EQ(angle(nullptr), kSunAngularRadius);
    EXPECT_FLOAT_EQ(angle({{"light_angle", 10}}), glm::radians(5.0F));
    EXPECT_FLOAT_EQ(radius("a note"), kBulbRadius_m);
    EXPECT_EQ(radius({{"light_radius", 0}}), 0.0F);
    EXPECT_EQ(radius({{"light_radius", 0.25}}), 0.25F);
    EXPECT_THAT(error_of(sized("point", {{"light_radius", -1}})), HasSubstr("/nodes/0/extras/light_radius"));
    EXPECT_THAT(error_of(sized("directional", {{"light_angle", "wide"}})), HasSubstr("/nodes/0/extras/light_angle"));
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

}  // namespace
}  // namespace rowland::scene
