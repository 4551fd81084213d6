#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/test_data.h"

namespace rowland::test {

/// Whether a user with a display can be played.
inline bool has_xvfb() {
    return std::system("command -v xvfb-run xdotool >/dev/null 2>&1") == 0;
}

}  // namespace rowland::test

/// Without a display to play in the test is skipped by name, or fails where test data is required.
#define ROWLAND_NEEDS_XVFB()                                                                       \
    if (!::rowland::test::has_xvfb()) {                                                            \
        if (::rowland::test::data_is_required()) FAIL() << "xvfb-run or xdotool is not installed"; \
        GTEST_SKIP() << "xvfb-run or xdotool is not installed";                                    \
    }                                                                                              \
    static_assert(true)
