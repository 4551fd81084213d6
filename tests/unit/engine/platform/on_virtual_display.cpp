// Runs all tests of a program on a virtual display, where they are alone with the pointer and the keyboard.

#include <cstdlib>

#include "tests/support/environment.h"
#include "tests/support/virtual_display.h"

namespace rowland::platform {
namespace {

class OnVirtualDisplay final : public testing::Environment {
 public:
    void SetUp() override {
        ROWLAND_NEEDS_VIRTUAL_DISPLAY();
        // Made before the driver is loaded, so that it ends after what the driver does at exit.
        static const test::VirtualDisplay display(ROWLAND_TEST_SCREEN_WIDTH, ROWLAND_TEST_SCREEN_HEIGHT);
        test::set_variable("DISPLAY", display.name());
        test::set_variable("WAYLAND_DISPLAY", std::nullopt);
    }
};

[[maybe_unused]] const testing::Environment* const kEnvironment =
    testing::AddGlobalTestEnvironment(new OnVirtualDisplay);  // GoogleTest owns it

}  // namespace
}  // namespace rowland::platform
