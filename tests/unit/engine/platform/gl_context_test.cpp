#include <gmock/gmock.h>

#include <cstdlib>

#include "engine/core/error.h"
#include "engine/platform/display.h"
#include "engine/platform/gl_context.h"
#include "engine/platform/window.h"
#include "tests/support/environment.h"
#include "tests/support/expect.h"

namespace rowland::platform {

namespace {

using ::testing::ElementsAre;
using testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(GpuChoice, SetsWhatTheGpusDriverReads) {
    EXPECT_THAT(offload_variables({"NVIDIA GeForce RTX 3060/PCIe/SSE2", "NVIDIA Corporation", "0000:01:00.0"}),
                ElementsAre(Pair("__NV_PRIME_RENDER_OFFLOAD", "1"), Pair("__GLX_VENDOR_LIBRARY_NAME", "nvidia")));
    EXPECT_THAT(offload_variables({"AMD Radeon RX 6800 (radeonsi, navi21)", "AMD", "0000:0a:00.1"}),
                ElementsAre(Pair("DRI_PRIME", "pci-0000_0a_00_1")));
    EXPECT_THAT(offload_variables({"llvmpipe (LLVM 15.0.6, 256 bits)", "Mesa", ""}),
                ElementsAre(Pair("LIBGL_ALWAYS_SOFTWARE", "1"), Pair("__GLX_VENDOR_LIBRARY_NAME", "mesa")));
    EXPECT_THAT(offload_variables({"AMD Radeon RX 6800 (radeonsi, navi21)", "AMD", ""}), IsEmpty());
}

TEST(GpuChoice, AnOptionPrecedesTheVariable) {
    test::set_variable(gpu_variable, std::nullopt);
    EXPECT_EQ(wanted_gpu(""), "");
    EXPECT_EQ(choose_gpu_of_windows(""), "");
    test::set_variable(gpu_variable, "nvidia");
    EXPECT_EQ(wanted_gpu(""), "nvidia");
    EXPECT_EQ(wanted_gpu("1"), "1");
    test::set_variable(gpu_variable, std::nullopt);
}

/// Takes the display away for good; nothing else in this program wants one.
class NoDisplay : public testing::Test {
 protected:
    void SetUp() override {
        test::set_variable("WAYLAND_DISPLAY", std::nullopt);
        test::set_variable("DISPLAY", std::nullopt);
        if (display_announced()) GTEST_SKIP() << "no variable announces displays on this system";
    }
};

TEST_F(NoDisplay, IsNoticedWithoutFailing) {
    EXPECT_FALSE(display_available());
}

TEST_F(NoDisplay, ThatDoesNotAnswerIsNoticedWithoutFailing) {
    test::set_variable("DISPLAY", ":4095");  // no server has so high a number
    EXPECT_FALSE(display_available());
}

TEST_F(NoDisplay, WindowSaysWhatIsMissingAndWhatToDo) {
    EXPECT_THAT(test::message_of([] { const Window window; }, Fault::System),
                testing::AllOf(HasSubstr("DISPLAY"), HasSubstr("run without a window")));
}

}  // namespace

}  // namespace rowland::platform
