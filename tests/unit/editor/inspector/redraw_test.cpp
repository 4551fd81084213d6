#include "editor/inspector/redraw.h"

#include <gtest/gtest.h>

namespace rowland::inspector {
namespace {

using std::chrono_literals::operator""ms;

TEST(Redraw, DrawsAWhileAfterAChangeThenRests) {
    Redraw redraw;
    Redraw::Clock::time_point now{};
    EXPECT_EQ(redraw.next(false, false, now += 1000ms), app::Next::Wait);
    EXPECT_EQ(redraw.next(true, false, now += 1000ms), app::Next::Frame);
    // Slow frames: several are drawn though the time is over.
    for (int frame = 0; frame < 5; ++frame) EXPECT_EQ(redraw.next(false, false, now += 1000ms), app::Next::Frame);
    EXPECT_EQ(redraw.next(false, false, now += 1000ms), app::Next::Wait);
    // Fast frames: the time counts.
    EXPECT_EQ(redraw.next(true, false, now += 1ms), app::Next::Frame);
    for (int frame = 0; frame < 200; ++frame) EXPECT_EQ(redraw.next(false, false, now += 1ms), app::Next::Frame);
    EXPECT_EQ(redraw.next(false, false, now += 100ms), app::Next::Wait);
}

TEST(Redraw, LooksForResultsWhileSomethingIsComputed) {
    Redraw redraw;
    EXPECT_EQ(redraw.next(false, true, Redraw::Clock::time_point(1000ms)), app::Next::Watch);
}

}  // namespace
}  // namespace rowland::inspector
