#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/core/error.h"
#include "engine/platform/window.h"

namespace rowland::platform {
namespace {

using testing::HasSubstr;

/// Takes the display away for good; nothing else in this program wants one.
class NoDisplay : public testing::Test {
 protected:
    void SetUp() override {
        unsetenv("WAYLAND_DISPLAY");
        unsetenv("DISPLAY");
    }
};

TEST_F(NoDisplay, IsNoticedWithoutFailing) {
    EXPECT_FALSE(display_available());
}

TEST_F(NoDisplay, ThatDoesNotAnswerIsNoticedWithoutFailing) {
    setenv("DISPLAY", ":4095", 1);  // no server has so high a number
    EXPECT_FALSE(display_available());
}

TEST_F(NoDisplay, WindowSaysWhatIsMissingAndWhatToDo) {
    try {
        const Window window;
        FAIL() << "opened a window without a display";
    } catch (const Error& error) {
        EXPECT_EQ(error.info().fault, Fault::System);
        EXPECT_THAT(error.what(), HasSubstr("DISPLAY"));
        EXPECT_THAT(error.what(), HasSubstr("run without a window"));
    }
}

}  // namespace
}  // namespace rowland::platform
