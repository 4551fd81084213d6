#include "modules/diffraction/model/shading_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace rowland::diffraction {
namespace {

TEST(ShadingPoint, RowsAreARightHandedBasis) {
    const ShadingPoint frame{.view = {0, 0, 1}, .normal = {0.0, 2.0, 1.0}, .grating = {1.0, 0.5, -0.2}};
    const glm::dmat3 m = world_to_tangent(frame);
    EXPECT_NEAR(glm::determinant(m), 1.0, 1e-15);
    const glm::dmat3 product = m * glm::transpose(m);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j ? 1.0 : 0.0, 1e-15);
    EXPECT_NEAR((m * glm::normalize(frame.normal)).z, 1.0, 1e-15);
    // h = n × g: the grating vector has no component along it and a positive one along g.
    EXPECT_NEAR((m * frame.grating).y, 0.0, 1e-15);
    EXPECT_GT((m * frame.grating).x, 0.0);
}

TEST(ShadingPoint, HIsNCrossG) {
    const glm::dmat3 m = world_to_tangent({.view = {0, 0, 1}, .normal = {0, 0, 1}, .grating = {1, 0, 0}});
    EXPECT_EQ(m * glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 1.0, 0.0));
}

TEST(ShadingPoint, KnowsWhatIsNoFrame) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(is_valid({.view = {0, 0, 1}, .normal = {0, 0, 1}, .grating = {1, 0, 0}}));
    EXPECT_FALSE(is_valid({.view = {0, 0, 0}, .normal = {0, 0, 1}, .grating = {1, 0, 0}}));
    EXPECT_FALSE(is_valid({.view = {0, 0, 1}, .normal = {0, 0, nan}, .grating = {1, 0, 0}}));
    EXPECT_FALSE(is_valid({.view = {0, 0, 1}, .normal = {0, 0, 1}, .grating = {0, 0, -3}}));
}

}  // namespace
}  // namespace rowland::diffraction
