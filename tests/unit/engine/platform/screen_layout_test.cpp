#include "engine/platform/screen_layout.h"

#include <gtest/gtest.h>

#include <array>

namespace rowland::platform {
namespace {

// A primary monitor, a larger one to its right and one that stands above, in negative coordinates.
const std::array kMonitors{ScreenArea{{0, 0}, {1920, 1080}}, ScreenArea{{1920, 0}, {2560, 1440}},
                           ScreenArea{{0, -1080}, {1920, 1080}}};

TEST(ScreenLayout, WindowBelongsToTheMonitorThatShowsMostOfIt) {
    EXPECT_EQ(monitor_showing({{100, 100}, {800, 600}}, kMonitors), 0U);
    EXPECT_EQ(monitor_showing({{1900, 100}, {800, 600}}, kMonitors), 1U);
    EXPECT_EQ(monitor_showing({{1500, 100}, {800, 600}}, kMonitors), 0U);  // 420 columns of it against 380
    EXPECT_EQ(monitor_showing({{1540, 100}, {800, 600}}, kMonitors), 1U);  // 380 against 420
    EXPECT_EQ(monitor_showing({{100, -500}, {800, 600}}, kMonitors), 2U);
}

TEST(ScreenLayout, EqualSharesGoToTheFirst) {
    EXPECT_EQ(monitor_showing({{1520, 100}, {800, 600}}, kMonitors), 0U);
}

TEST(ScreenLayout, UnseenWindowBelongsToThePrimaryMonitor) {
    EXPECT_EQ(monitor_showing({{-5000, -5000}, {800, 600}}, kMonitors), 0U);
    EXPECT_EQ(monitor_showing({{100, 100}, {0, 0}}, kMonitors), 0U);
}

}  // namespace
}  // namespace rowland::platform
