#pragma once

#include <gtest/gtest.h>

#include <string>

#include "engine/core/error.h"

namespace rowland::test {

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
