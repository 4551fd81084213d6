#include "engine/core/log.h"

#include <gtest/gtest.h>

#include <string>

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

}  // namespace
}  // namespace rowland
