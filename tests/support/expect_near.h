#pragma once

#include <gtest/gtest.h>

#include <glm/vec3.hpp>

namespace rowland::test {

/// Expects every component of `expected` in `value`, within `tolerance`.
inline void expect_near(const glm::dvec3& value, const glm::dvec3& expected, double tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance) << "component " << i;
}

}  // namespace rowland::test
