#pragma once

#include <gtest/gtest.h>

#include "engine/core/parallel.h"

namespace rowland::test {

/// Expects `run` to return the same with one thread, with two and with five.
template <typename Run>
void expect_same_on_any_threads(const Run& run) {
    const auto with = [&](unsigned threads) {
        const ThreadLimit limit(threads);
        return run();
    };
    const auto expected = with(1);
    for (const unsigned threads : {2U, 5U}) EXPECT_EQ(with(threads), expected) << threads << " threads";
}

}  // namespace rowland::test
