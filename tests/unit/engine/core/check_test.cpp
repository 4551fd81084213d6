#include "engine/core/check.h"

#include <gtest/gtest.h>

namespace rowland {
namespace {

TEST(CheckDeathTest, FailedComparisonPrintsBothOperands) {
    const int bands = 3;
    EXPECT_DEATH(ROWLAND_CHECK_OP(bands, >=, 5), "check_test.cpp:[0-9]+: contract violated: bands >= 5 with 3 and 5");
}

TEST(CheckDeathTest, FailedConditionPrintsItsMessage) {
    EXPECT_DEATH(ROWLAND_CHECK(1 > 2, "one is not above two"), "contract violated: one is not above two");
}

TEST(Check, OperandsAreEvaluatedOnce) {
    int evaluations = 0;
    ROWLAND_CHECK_OP(++evaluations, ==, 1);
    ROWLAND_CHECK(++evaluations == 2, "evaluated twice");
    EXPECT_EQ(evaluations, 2);
}

}  // namespace
}  // namespace rowland
