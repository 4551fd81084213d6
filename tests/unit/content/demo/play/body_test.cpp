#include "content/demo/play/body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace rowland::demo {
namespace {

double angle_of(const glm::dquat& q) {
    return 2.0 * std::atan2(glm::length(glm::dvec3(q.x, q.y, q.z)), std::abs(q.w));
}

Body thrown(double speed) {
    Body body;
    body.state.spin = {0.0, speed, 0.0};
    return body;
}

TEST(DemoBody, AThrownBodyTurnsBySpeedTimesDecayAndComesToRest) {
    // 1 rad/s for the decay's 2.5 s: 2.5 rad in all. What it no longer turns below its slowest speed is 1e-3 of that.
    Body body = thrown(1.0);
    for (int i = 0; i < 120 * 60; ++i) step(body, 1.0 / 120.0);
    EXPECT_NEAR(angle_of(body.state.turned), kSpinDecay_s, 3e-3);
    EXPECT_EQ(body.state.spin, glm::dvec3(0.0));
}

TEST(DemoBody, TheLengthOfStepsHardlyMatters) {
    Body fine = thrown(8.0);
    Body coarse = thrown(8.0);
    for (int i = 0; i < 240; ++i) step(fine, 1.0 / 240.0);
    for (int i = 0; i < 10; ++i) step(coarse, 1.0 / 10.0);
    // Both are exact; what differs is rounding.
    EXPECT_NEAR(glm::length(fine.state.spin - coarse.state.spin), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(glm::dot(fine.state.turned, coarse.state.turned)), 1.0, 1e-12);
    EXPECT_GT(angle_of(coarse.state.turned), 0.1);
}

TEST(DemoBody, ItTurnsByItselfUntilTouched) {
    Body body;
    body.spin_axis = {0.0F, 0.0F, 1.0F};
    body.idle_spin = 0.5;
    for (int i = 0; i < 120; ++i) step(body, 1.0 / 120.0);
    EXPECT_NEAR(angle_of(glm::dquat(transform_of(body, {0, 1, 0}).rotation)), 0.5, 1e-6);
    body.state.touched = true;
    for (int i = 0; i < 120; ++i) step(body, 1.0 / 120.0);
    EXPECT_NEAR(angle_of(glm::dquat(transform_of(body, {0, 1, 0}).rotation)), 0.5, 1e-6);
}

TEST(DemoBody, ItsCentreStaysWhereItWasHoweverItIsTurned) {
    Body body;
    body.rest = {.translation = {1.0F, 2.0F, 3.0F},
                 .rotation = glm::angleAxis(0.7F, glm::normalize(glm::vec3(1.0F, 2.0F, -1.0F))),
                 .scale = {1.0F, 2.0F, 0.5F}};
    body.centre = {0.3F, -0.2F, 0.4F};
    const auto centre_of = [&](const scene::Transform& at) {
        return glm::vec3(at.matrix() * glm::vec4(body.centre, 1.0F));
    };
    const glm::vec3 before = centre_of(transform_of(body, {0, 1, 0}));
    turn(body, glm::angleAxis(1.1, glm::normalize(glm::dvec3(0.2, 1.0, 0.4))));
    const scene::Transform turned = transform_of(body, {0, 1, 0});
    EXPECT_GT(glm::distance(turned.translation, body.rest.translation), 0.1F);
    EXPECT_NEAR(glm::distance(centre_of(turned), before), 0.0F, 1e-5F);
}

TEST(DemoBody, RaisedItRisesByItsClearanceAndComesDownAgain) {
    Body body;
    body.clearance = 0.2F;
    body.state.raised = true;
    for (int i = 0; i < 120 * 3; ++i) step_lift(body, 1.0 / 120.0);
    EXPECT_EQ(transform_of(body, {0.0F, 0.5F, 0.0F}).translation, glm::vec3(0.0F, 0.1F, 0.0F));
    body.state.raised = false;
    for (int i = 0; i < 120 * 3; ++i) step_lift(body, 1.0 / 120.0);
    EXPECT_EQ(transform_of(body, {0.0F, 0.5F, 0.0F}).translation, glm::vec3(0.0F));
}

}  // namespace
}  // namespace rowland::demo
