// Runs all tests of a program on a virtual display, where they are alone with the pointer and the keyboard.
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "tests/support/virtual_display.h"

namespace rowland::platform {
namespace {

class OnVirtualDisplay final : public testing::Environment {
 public:
    void SetUp() override {
        ROWLAND_NEEDS_VIRTUAL_DISPLAY();
        display_.emplace(ROWLAND_TEST_SCREEN_WIDTH, ROWLAND_TEST_SCREEN_HEIGHT);
        setenv("DISPLAY", display_->name().c_str(), 1);
        unsetenv("WAYLAND_DISPLAY");
    }
    void TearDown() override { display_.reset(); }

 private:
    std::optional<test::VirtualDisplay> display_;
};

[[maybe_unused]] const testing::Environment* const kEnvironment =
    testing::AddGlobalTestEnvironment(new OnVirtualDisplay);  // GoogleTest owns it

}  // namespace
}  // namespace rowland::platform
