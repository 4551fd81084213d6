#include "engine/platform/gpu_choice.h"

#include <gmock/gmock.h>

#include <cstdlib>

namespace rowland::platform {
namespace {

using ::testing::ElementsAre;
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
    unsetenv(gpu_variable);
    EXPECT_EQ(wanted_gpu(""), "");
    EXPECT_EQ(choose_gpu_of_windows(""), "");
    setenv(gpu_variable, "nvidia", 1);
    EXPECT_EQ(wanted_gpu(""), "nvidia");
    EXPECT_EQ(wanted_gpu("1"), "1");
    unsetenv(gpu_variable);
}

}  // namespace
}  // namespace rowland::platform
