#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"

namespace rowland::test {

/// Expects every component of `expected` in `value`, within `tolerance`.
inline void expect_near(const glm::dvec3& value, const glm::dvec3& expected, double tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance) << "component " << i;
}

/// A text as bytes.
inline std::vector<std::byte> bytes_of(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

/// The message of the Error that `action` throws; fails the test if it throws none, or one of another fault.
template <typename Action>
std::string message_of(const Action& action, Fault fault = Fault::Input) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.info().fault, fault);
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

}  // namespace rowland::test
