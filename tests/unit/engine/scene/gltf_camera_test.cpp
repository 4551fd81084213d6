#include "engine/scene/gltf_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/engine/scene/hand_written_gltf.h"

namespace rowland::scene {
namespace {

using nlohmann::json;
using test::error_of;
using test::load;
using testing::HasSubstr;

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

TEST(GltfCamera, CamerasOfHiddenNodesAreLeftOut) {
    json file = perspective({{"yfov", 0.5}, {"znear", 0.25}});
    file["scenes"][0]["nodes"] = json::array();
    EXPECT_TRUE(load(file).cameras.empty());
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

}  // namespace
}  // namespace rowland::scene
