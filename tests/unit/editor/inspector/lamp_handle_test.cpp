#include "editor/inspector/lamp_handle.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace rowland::inspector {
namespace {

constexpr float kAspect = 1.5F;

TEST(LampHandle, DraggedToWhereItIsTheLampStays) {
    for (const float azimuth : {-120.0F, -40.0F, 0.0F, 35.0F, 170.0F})
        for (const float elevation : {0.0F, 20.0F, 50.0F, 85.0F}) {
            Stage stage{.lamp_azimuth_deg = azimuth, .lamp_elevation_deg = elevation};
            const LampHandle handle = lamp_handle(opening_camera(), kAspect, stage);
            const glm::vec3 before = lamp_direction(stage);
            drag_lamp(stage, opening_camera(), kAspect, handle.at, handle.behind);
            // Near the rim the sphere is seen at a grazing angle, where floats of the picture are coarse.
            EXPECT_LT(glm::distance(lamp_direction(stage), before), 0.01F) << azimuth << ", " << elevation;
        }
}

TEST(LampHandle, FollowsTheMouseInsideTheRim) {
    Stage stage;
    for (const glm::vec2 at : {glm::vec2(0.5F, 0.3F), {0.6F, 0.35F}, {0.42F, 0.2F}}) {
        drag_lamp(stage, opening_camera(), kAspect, at, false);
        EXPECT_LT(glm::distance(lamp_handle(opening_camera(), kAspect, stage).at, at), 1e-3F);
    }
}

TEST(LampHandle, OutsideTheRimAndBelowTheHorizonItEnds) {
    Stage stage;
    drag_lamp(stage, opening_camera(), kAspect, {0.99F, 0.3F}, false);
    const LampHandle handle = lamp_handle(opening_camera(), kAspect, stage);
    EXPECT_LT(handle.at.x, 0.95F);
    EXPECT_GT(handle.at.x, 0.6F);
    drag_lamp(stage, opening_camera(), kAspect, {0.5F, 0.95F}, false);
    EXPECT_EQ(stage.lamp_elevation_deg, 0.0F);
}

TEST(LampHandle, IsInThePictureAtAllDistances) {
    for (const float scale : {0.3F, 1.0F, 8.0F}) {
        scene::Camera camera = opening_camera();
        camera.eye = camera.target + scale * (camera.eye - camera.target);
        const LampHandle handle = lamp_handle(camera, kAspect, {.lamp_azimuth_deg = 0, .lamp_elevation_deg = 90});
        EXPECT_GT(handle.at.y, 0.0F) << scale;
        EXPECT_LT(handle.at.y, 0.3F) << scale;
    }
}

}  // namespace
}  // namespace rowland::inspector
