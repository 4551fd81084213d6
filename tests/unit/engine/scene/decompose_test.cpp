#include "engine/scene/decompose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace rowland::scene {
namespace {

float largest_difference(const glm::mat4& a, const glm::mat4& b) {
    float largest = 0.0F;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) largest = std::max(largest, std::abs(a[column][row] - b[column][row]));
    return largest;
}

TEST(Decompose, PartsMakeTheMatrixAgain) {
    const glm::dquat turn = glm::angleAxis(2.1, glm::normalize(glm::dvec3(1.0, -2.0, 0.5)));
    for (const glm::dvec3 scale :
         {glm::dvec3(1.0), glm::dvec3(0.01, 3.0, 7.0), glm::dvec3(-2.0, 1.0, 0.5), glm::dvec3(-1.0, -1.0, -1.0),
          glm::dvec3(1.0, 0.0, 2.0), glm::dvec3(0.0, 0.0, 2.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0)}) {
        const glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(4.0, 5.0, -6.0)) * glm::mat4_cast(turn) *
                                  glm::scale(glm::dmat4(1.0), scale);
        const Decomposition parts = decompose(matrix);
        EXPECT_FALSE(parts.sheared);
        // Rounding of floats up to 7.
        EXPECT_LT(largest_difference(parts.transform.matrix(), glm::mat4(matrix)), 4e-6F) << scale.x << " " << scale.y;
        EXPECT_NEAR(glm::length(parts.transform.rotation), 1.0F, 1e-6F);
    }
}

TEST(Decompose, ShearIsReportedAndLost) {
    glm::dmat4 matrix(1.0);
    matrix[1][0] = 0.5;
    const Decomposition parts = decompose(matrix);
    EXPECT_TRUE(parts.sheared);
    EXPECT_NEAR(glm::length(parts.transform.rotation), 1.0F, 1e-6F);
    EXPECT_EQ(parts.transform.scale.x, 1.0F);
    matrix[1][0] = 1e-7;  // rounding
    EXPECT_FALSE(decompose(matrix).sheared);
}

}  // namespace
}  // namespace rowland::scene
