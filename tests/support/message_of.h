#pragma once

#include <gtest/gtest.h>

#include <string>

#include "engine/core/error.h"

namespace rowland::test {

/// The message of the Error (input) that `action` throws; fails the test if it throws none.
template <typename Action>
std::string message_of(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.info().fault, Fault::Input);
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

}  // namespace rowland::test
