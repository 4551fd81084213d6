#include "engine/gpu/debug.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "engine/platform/headless_context.h"

namespace rowland {

namespace {

/// A draw call with a mode that does not exist.
void make_an_error(bool fatal) {
    const platform::HeadlessContext context;
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

TEST(DebugOutput, NotesAreNotFatal) {
    testing::internal::CaptureStderr();
    const platform::HeadlessContext context;
    gpu::enable_debug_output(true);
    const char message[] = "rather slow";
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_PERFORMANCE, 1, GL_DEBUG_SEVERITY_MEDIUM, -1,
                         message);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("warning: OpenGL [1]: rather slow"), std::string::npos);
}

TEST(DebugOutputDeathTest, DeprecatedUseIsFatal) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto insert = [] {
        const platform::HeadlessContext context;
        gpu::enable_debug_output(true);
        glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR, 2,
                             GL_DEBUG_SEVERITY_MEDIUM, -1, "from another age");
    };
    EXPECT_DEATH(insert(), "from another age");
}

}  // namespace

}  // namespace rowland
