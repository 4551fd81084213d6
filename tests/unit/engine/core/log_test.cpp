#include <gtest/gtest.h>

#include "engine/core/log.h"
#include "engine/core/parallel.h"

namespace rowland {

namespace {

TEST(Log, LinesGoToStandardErrorWithTheirLevel) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    log_info("{} bands", 5);
    log_warning("{} NaN", 2);
    log_error("no {}", "light");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "5 bands\nwarning: 2 NaN\nerror: no light\n");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(Progress, IsSilentWhereStandardErrorIsNoTerminal) {
    testing::internal::CaptureStderr();
    {
        Progress progress("baking", 1000);
        parallel_for(1000, [&](std::size_t) { progress.advance(); });
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace

}  // namespace rowland
