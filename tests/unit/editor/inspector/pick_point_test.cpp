#include "editor/inspector/pick_point.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "editor/inspector/preview.h"

namespace rowland::inspector {
namespace {

const scene::Camera kAhead{.eye = {0.0F, 0.0F, 0.4F}, .target = {0.0F, 0.0F, 0.0F}};

/// Through a point of a square picture.
Ray through(const glm::vec2& at) {
    return scene::ray_through(kAhead, at, {1.0F, 1.0F});
}

TEST(PickPoint, TheMiddleOfASphereFacesTheEye) {
    const auto point = pick_point(preview_mesh(PreviewShape::Sphere), glm::mat4(1.0F), through({0.5F, 0.5F}));
    ASSERT_TRUE(point);
    // The sphere is of flat facets 2.8° wide, its normals are interpolated.
    EXPECT_GT(glm::dot(point->frame.normal, glm::dvec3(0.0, 0.0, 1.0)), 0.9999);
    EXPECT_GT(glm::dot(point->frame.view, glm::dvec3(0.0, 0.0, 1.0)), 0.9999);
    EXPECT_LT(std::abs(glm::dot(point->frame.grating, point->frame.normal)), 1e-3);
    EXPECT_GT(std::abs(point->frame.grating.x), 0.999);  // along the longitude
}

TEST(PickPoint, BesideTheSurfaceThereIsNothing) {
    const scene::Mesh disc = preview_mesh(PreviewShape::Disc);
    const glm::mat4 upright = glm::rotate(glm::mat4(1.0F), glm::radians(90.0F), {1.0F, 0.0F, 0.0F});
    EXPECT_FALSE(pick_point(disc, upright, through({0.5F, 0.5F})));  // the hole
    EXPECT_FALSE(pick_point(disc, upright, through({0.01F, 0.01F})));
    const auto point = pick_point(disc, upright, through({0.62F, 0.5F}));
    ASSERT_TRUE(point);
    EXPECT_GT(point->frame.grating.x, 0.99);  // radial, to the right of the middle
    EXPECT_NEAR(point->frame.normal.z, 1.0, 1e-5);
}

TEST(PreviewShapes, GratingVectorsLieInTheirSurface) {
    for (const PreviewShape shape :
         {PreviewShape::Disc, PreviewShape::Sphere, PreviewShape::Card, PreviewShape::Sheet}) {
        const scene::Mesh mesh = preview_mesh(shape);
        const scene::Bounds box = scene::bounds(mesh);
        EXPECT_GT(box.maximum.x - box.minimum.x, 0.08F) << preview_shape_name(shape);
        EXPECT_LT(box.maximum.x - box.minimum.x, 0.16F) << preview_shape_name(shape);
        for (std::size_t i = 0; i < mesh.positions.size(); i += 17) {
            // Floats of unit length.
            EXPECT_NEAR(glm::length(mesh.normals[i]), 1.0F, 1e-5F);
            EXPECT_NEAR(glm::dot(mesh.normals[i], glm::vec3(mesh.tangents[i])), 0.0F, 1e-5F);
        }
    }
}

TEST(PreviewShapes, AModelIsFitted) {
    const scene::Bounds box{.minimum = {970.0F, -15.0F, -15.0F}, .maximum = {1000.0F, 15.0F, 15.0F}};
    EXPECT_NEAR(30.0F * fitting_scale(box), 0.116F, 1e-6F);
    EXPECT_EQ(fitting_scale({}), 1.0F);
}

constexpr float kAspect = 1.5F;

TEST(LampHandle, DraggedToWhereItIsTheLampStays) {
    for (const float azimuth : {-120.0F, -40.0F, 0.0F, 35.0F, 170.0F})
        for (const float elevation : {0.0F, 20.0F, 50.0F, 85.0F}) {
            Stage stage{.lamp_azimuth_deg = azimuth, .lamp_elevation_deg = elevation};
            const LampHandle handle = lamp_handle(opening_camera(), kAspect, stage);
            const glm::vec3 before = lamp_direction(stage);
            drag_lamp(stage, opening_camera(), kAspect, handle.position, handle.behind);
            // Near the rim the sphere is seen at a grazing angle, where floats of the picture are coarse.
            EXPECT_LT(glm::distance(lamp_direction(stage), before), 0.01F) << azimuth << ", " << elevation;
        }
}

TEST(LampHandle, FollowsTheMouseInsideTheRim) {
    Stage stage;
    for (const glm::vec2 at : {glm::vec2(0.5F, 0.3F), {0.6F, 0.35F}, {0.42F, 0.2F}}) {
        drag_lamp(stage, opening_camera(), kAspect, at, false);
        EXPECT_LT(glm::distance(lamp_handle(opening_camera(), kAspect, stage).position, at), 1e-3F);
    }
}

TEST(LampHandle, OutsideTheRimAndBelowTheHorizonItEnds) {
    Stage stage;
    drag_lamp(stage, opening_camera(), kAspect, {0.99F, 0.3F}, false);
    const LampHandle handle = lamp_handle(opening_camera(), kAspect, stage);
    EXPECT_LT(handle.position.x, 0.95F);
    EXPECT_GT(handle.position.x, 0.6F);
    drag_lamp(stage, opening_camera(), kAspect, {0.5F, 0.95F}, false);
    EXPECT_EQ(stage.lamp_elevation_deg, 0.0F);
}

TEST(LampHandle, IsInThePictureAtAllDistances) {
    for (const float scale : {0.3F, 1.0F, 8.0F}) {
        scene::Camera camera = opening_camera();
        camera.eye = camera.target + scale * (camera.eye - camera.target);
        const LampHandle handle = lamp_handle(camera, kAspect, {.lamp_azimuth_deg = 0, .lamp_elevation_deg = 90});
        EXPECT_GT(handle.position.y, 0.0F) << scale;
        EXPECT_LT(handle.position.y, 0.3F) << scale;
    }
}

}  // namespace
}  // namespace rowland::inspector
