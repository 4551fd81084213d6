#include "engine/core/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <new>
#include <stdexcept>

#include "engine/core/error.h"

namespace rowland {
namespace {

/// Exit code of a body that throws `exception`; `message` receives what was printed.
template <typename Exception>
int code_of(const Exception& exception, std::string& message) {
    testing::internal::CaptureStderr();
    const int code = run_program([&]() -> int { throw exception; });
    message = testing::internal::GetCapturedStderr();
    return code;
}

TEST(Program, ReturnsWhatItsBodyReturns) {
    EXPECT_EQ(run_program([] { return 0; }), 0);
    EXPECT_EQ(run_program([] { return 2; }), 2);
}

TEST(Program, BadInputIsCodeTwoAndOneLine) {
    std::string message;
    const Error error({.file = "a.json", .location = {}, .found = "a\nb", .expected = {}, .remedy = {}});
    EXPECT_EQ(code_of(error, message), 2);
    EXPECT_EQ(message, "error: a.json: a\\x0ab\n");
}

TEST(Program, AnyOtherFailureIsCodeOne) {
    std::string message;
    const Error error(
        {.file = "a", .location = {}, .found = "disk full", .expected = {}, .remedy = {}, .fault = Fault::System});
    EXPECT_EQ(code_of(error, message), 1);
    EXPECT_EQ(message, "error: a: disk full\n");
    EXPECT_EQ(code_of(std::bad_alloc(), message), 1);
    EXPECT_EQ(message, "error: out of memory\n");
    EXPECT_EQ(code_of(std::runtime_error("odd"), message), 1);
    EXPECT_EQ(message, "error: odd\n");
}

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

}  // namespace
}  // namespace rowland
