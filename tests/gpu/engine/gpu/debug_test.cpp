#include "engine/gpu/debug.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "engine/platform/headless_context.h"

namespace rowland {

namespace {

/// A draw call with a mode that does not exist.
void make_an_error(bool fatal) {
    const platform::HeadlessContext context({.debug = true});
    gpu::enable_debug_output(fatal);
    glDrawArrays(0xffff, 0, 3);
}

TEST(DebugOutputDeathTest, AnErrorOfTheDriverIsFatalWhereAskedFor) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_DEATH(make_an_error(true), "error: OpenGL.*GL_INVALID_ENUM");
}

TEST(DebugOutput, AnErrorOfTheDriverIsLoggedOtherwise) {
    testing::internal::CaptureStderr();
    make_an_error(false);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("error: OpenGL"), std::string::npos);
}

TEST(DebugOutput, AMessageIsLoggedOnce) {
    testing::internal::CaptureStderr();
    const platform::HeadlessContext context({.debug = true});
    gpu::enable_debug_output(false);
    const auto say = [](const char* message) {
        glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_PERFORMANCE, 1, GL_DEBUG_SEVERITY_MEDIUM, -1,
                             message);
    };
    for (const char* message : {"slow", "slower", "slow", "slower"}) say(message);
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
}

TEST(DebugOutputDeathTest, NeedsADebugContext) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto enable = [] {
        const platform::HeadlessContext context({.debug = false});
        gpu::enable_debug_output(true);
    };
    EXPECT_DEATH(enable(), "a debug context");
}

TEST(DebugOutput, NotesAreNotFatal) {
    testing::internal::CaptureStderr();
    const platform::HeadlessContext context({.debug = true});
    gpu::enable_debug_output(true);
    const char message[] = "rather slow";
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_PERFORMANCE, 1, GL_DEBUG_SEVERITY_MEDIUM, -1,
                         message);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("warning: OpenGL [1]: rather slow"), std::string::npos);
}

TEST(DebugOutputDeathTest, DeprecatedUseIsFatal) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto insert = [] {
        const platform::HeadlessContext context({.debug = true});
        gpu::enable_debug_output(true);
        glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR, 2,
                             GL_DEBUG_SEVERITY_MEDIUM, -1, "from another age");
    };
    EXPECT_DEATH(insert(), "from another age");
}

}  // namespace

}  // namespace rowland
