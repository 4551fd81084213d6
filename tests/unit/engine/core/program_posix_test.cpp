// With files that POSIX systems have.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>

#include "engine/core/program.h"
#include "tests/support/environment.h"

namespace rowland {

namespace {

TEST(Program, ResultsThatCannotBeWrittenAreCodeOne) {
    std::fflush(stdout);
    const int saved = ::dup(STDOUT_FILENO);
    const int full = ::open("/dev/full", O_WRONLY);
    if (full < 0) GTEST_SKIP() << "no /dev/full";
    ASSERT_GE(::dup2(full, STDOUT_FILENO), 0);
    testing::internal::CaptureStderr();
    const int code = run_program([] {
        std::puts("result");
        return 0;
    });
    const std::string message = testing::internal::GetCapturedStderr();
    ASSERT_GE(::dup2(saved, STDOUT_FILENO), 0);
    ::close(saved);
    ::close(full);
    std::clearerr(stdout);
    EXPECT_EQ(code, 1);
    EXPECT_EQ(message, "error: standard output: writing failed: No space left on device\n");
}

TEST(HelperProgram, IsLookedForInTheFolderTheUserNames) {
    test::set_variable("ROWLAND_HELPER_FOLDER", "/bin");
    const std::filesystem::path shell = helper_program("sh");
    test::set_variable("ROWLAND_HELPER_FOLDER", std::nullopt);
    EXPECT_EQ(shell, "/bin/sh");
}

}  // namespace

}  // namespace rowland
