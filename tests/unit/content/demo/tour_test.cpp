#include "content/demo/camera_path.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace rowland::demo {
namespace {

std::vector<scene::Camera> views() {
    return {{.eye = {0, 1, 2}, .target = {0, 0, 0}, .vertical_field_of_view = 0.5F},
            {.eye = {1, 1, 1}, .target = {0.5F, 0, 0}, .vertical_field_of_view = 0.7F},
            {.eye = {2, 0.5F, 2}, .target = {1, 0, 0.5F}, .vertical_field_of_view = 0.4F}};
}

TEST(DemoTour, GoesThroughEveryView) {
    for (std::size_t i = 0; i < 3; ++i) {
        const scene::Camera camera = tour(views(), 0.5 * static_cast<double>(i));
        EXPECT_EQ(camera.eye, views()[i].eye);
        EXPECT_EQ(camera.target, views()[i].target);
        EXPECT_EQ(camera.vertical_field_of_view, views()[i].vertical_field_of_view);
    }
}

TEST(DemoTour, MakesNoJumpsAndNoKinks) {
    // Over 1000 steps of a way of about 4 m: a step is some 4 mm, and changes from one to the next by far less.
    constexpr int kSteps = 1000;
    glm::vec3 last_step(0.0F);
    for (int i = 0; i < kSteps; ++i) {
        const glm::vec3 step =
            tour(views(), (i + 1.0) / kSteps).eye - tour(views(), static_cast<double>(i) / kSteps).eye;
        EXPECT_LT(glm::length(step), 0.02F) << i;
        EXPECT_LT(i > 0 ? glm::distance(step, last_step) : 0.0F, 2e-4F) << i;
        last_step = step;
    }
}

TEST(DemoTour, ATurntableKeepsHeightAndDistanceAndComesBack) {
    const scene::Camera start = views()[1];
    for (const double part : {0.25, 0.5, 1.0}) {
        const scene::Camera camera = turned(start, part);
        EXPECT_EQ(camera.target, start.target);
        EXPECT_EQ(camera.eye.y, start.eye.y);
        EXPECT_NEAR(glm::distance(camera.eye, camera.target), glm::distance(start.eye, start.target), 1e-5F);
    }
    EXPECT_NEAR(glm::distance(turned(start, 0.5).eye, start.eye),
                2.0F * glm::length(glm::vec2(start.eye.x - start.target.x, start.eye.z - start.target.z)), 1e-5F);
    EXPECT_NEAR(glm::distance(turned(start, 1.0).eye, start.eye), 0.0F, 1e-5F);
}

TEST(DemoTour, ASingleViewIsFlownAround) {
    const std::vector<scene::Camera> one{views()[0]};
    EXPECT_NEAR(glm::distance(tour(one, 0.0).eye, one[0].eye), 0.0F, 1e-5F);
    EXPECT_GT(glm::distance(tour(one, 0.5).eye, one[0].eye), 2.0F);
    EXPECT_EQ(tour(one, 0.5).target, one[0].target);
}

}  // namespace
}  // namespace rowland::demo
