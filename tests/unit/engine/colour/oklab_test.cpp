#include "engine/colour/oklab.h"

#include <gtest/gtest.h>

#include <glm/vec3.hpp>

#include "tests/support/expect_near.h"

namespace rowland::colour {

namespace {

glm::dvec3 oklab(const glm::dvec3& rgb) {
    return oklab_of_lms(rec709_to_oklab_lms() * rgb);
}

/// The values that CSS Color 4 prints for sRGB's primaries.
TEST(Oklab, PrimariesHaveThePublishedValues) {
    test::expect_near(oklab(glm::dvec3(1.0)), {1.0, 0.0, 0.0}, 1e-6);
    test::expect_near(oklab({1, 0, 0}), {0.62796, 0.22486, 0.12585}, 2e-5);
    test::expect_near(oklab({0, 1, 0}), {0.86644, -0.23389, 0.17950}, 2e-5);
    test::expect_near(oklab({0, 0, 1}), {0.45201, -0.03246, -0.31153}, 2e-5);
}

TEST(Oklab, InverseReturns) {
    const glm::dvec3 lms(0.4, 0.02, 1.7);
    test::expect_near(oklab_to_lms(oklab_of_lms(lms)), lms, 1e-12);
}

TEST(Oklab, HueDifferenceIsTheAngleAndIgnoresLightness) {
    EXPECT_NEAR(oklab_hue_difference_deg({0.3, 1.0, 0.0}, {0.9, 0.0, 2.0}), 90.0, 1e-12);
    EXPECT_NEAR(oklab_hue_difference_deg({0.3, -1.0, 0.1}, {0.9, -1.0, -0.1}), 11.4212, 1e-4);
}

}  // namespace

}  // namespace rowland::colour
