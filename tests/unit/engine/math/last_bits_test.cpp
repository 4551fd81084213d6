#include "engine/math/last_bits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rowland::math {
namespace {

TEST(LastBits, WhatIsRoundingBesideTheLargestNumberIsZeroWithoutASign) {
    std::vector<double> values{-0.75, 3e-15, -3e-15, 0.25 + 1e-14, -0.0};
    drop_last_bits(values);
    EXPECT_EQ(values, (std::vector<double>{-0.75, 0.0, 0.0, 0.25, 0.0}));
    for (const std::size_t zero : {1U, 2U, 4U}) EXPECT_FALSE(std::signbit(values[zero]));
}

TEST(LastBits, NumbersKeepMoreBitsThanAFloatHas) {
    for (const double scale : {1e-200, 1.0, 3e5}) {
        const std::vector<double> before{scale, scale / 3.0, scale / 700.0};
        for (const int bits : {36, 44}) {
            std::vector<double> values = before;
            drop_last_bits(values, bits);
            for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], before[i], std::ldexp(scale, -bits));
            EXPECT_EQ(static_cast<float>(values[0]), static_cast<float>(before[0]));
        }
    }
}

TEST(LastBits, ZerosStay) {
    std::vector<double> values{0.0, 0.0};
    drop_last_bits(values);
    EXPECT_EQ(values, (std::vector<double>{0.0, 0.0}));
}

}  // namespace
}  // namespace rowland::math
