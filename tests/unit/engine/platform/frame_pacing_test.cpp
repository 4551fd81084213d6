#include "engine/platform/frame_pacing.h"

#include <gtest/gtest.h>

#include <thread>

namespace rowland::platform {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;

/// Steps of `total` cut into frames of `frame`, the last one shorter.
int steps_in(nanoseconds total, nanoseconds frame) {
    FixedStep pace;
    int steps = 0;
    for (nanoseconds left = total; left > 0ns; left -= frame) steps += pace.advance(std::min(left, frame));
    return steps;
}

TEST(FixedStep, StepsDependOnTheTimeAloneNotOnTheFrames) {
    // 120 steps per second, so 10 s are 1200 steps exactly, also where neither frame nor step is a whole number of ns.
    for (const nanoseconds frame : {nanoseconds(1'000'000'000 / 60), nanoseconds(1'000'000'000 / 144),
                                    nanoseconds(1'000'000'000 / 23), nanoseconds(8'333'333), nanoseconds(100'000)}) {
        EXPECT_EQ(steps_in(10s, frame), 1200) << frame.count();
        EXPECT_EQ(steps_in(10s - 1ns, frame), 1199) << frame.count();
    }
}

TEST(FixedStep, LongFrameIsCut) {
    FixedStep pace;
    EXPECT_EQ(pace.advance(std::chrono::hours(1)), 30);  // a quarter of a second
    EXPECT_EQ(pace.advance(0ns), 0);
    FixedStep patient(120, 1s);
    EXPECT_EQ(patient.advance(std::chrono::hours(1)), 120);
}

TEST(FixedStep, NegativeTimeCountsAsNone) {
    FixedStep pace(100);
    pace.advance(9ms);
    EXPECT_EQ(pace.advance(-5ms), 0);
    EXPECT_EQ(pace.advance(1ms), 1);
}

TEST(FrameTimes, StatisticsAreThoseOfTheTimes) {
    FrameTimes times(100);
    for (int i = 100; i >= 1; --i) times.add(milliseconds(i));
    const FrameStatistics statistics = times.statistics();
    EXPECT_EQ(statistics.count, 100U);
    EXPECT_DOUBLE_EQ(statistics.mean_ms, 50.5);
    EXPECT_DOUBLE_EQ(statistics.minimum_ms, 1.0);
    EXPECT_DOUBLE_EQ(statistics.median_ms, 50.0);
    EXPECT_DOUBLE_EQ(statistics.percentile_90_ms, 90.0);
    EXPECT_DOUBLE_EQ(statistics.percentile_95_ms, 95.0);
    EXPECT_DOUBLE_EQ(statistics.percentile_99_ms, 99.0);
    EXPECT_DOUBLE_EQ(statistics.maximum_ms, 100.0);
}

TEST(FrameTimes, TheLastFramesAreInOrder) {
    FrameTimes times(3);
    EXPECT_TRUE(times.in_order_ms().empty());
    for (const int ms : {1, 2}) times.add(std::chrono::milliseconds(ms));
    EXPECT_EQ(times.in_order_ms(), (std::vector<float>{1, 2}));
    for (const int ms : {3, 4, 5}) times.add(std::chrono::milliseconds(ms));
    EXPECT_EQ(times.in_order_ms(), (std::vector<float>{3, 4, 5}));
}

TEST(FrameTimes, FewFramesHaveTheStatisticsOfTheLastOnes) {
    const struct {
        std::vector<int> ms;
        std::size_t count;
        double mean, median, percentile_95, maximum;
    } cases[] = {{{}, 0, 0, 0, 0, 0},
                 {{16}, 1, 16, 16, 16, 16},
                 {{3, 1, 2}, 3, 2, 2, 3, 3},              // ranks 1.5 and 2.85 go to the slower frame
                 {{500, 1, 2, 3}, 3, 2, 2, 3, 3},         // the oldest is forgotten
                 {{500, 1, 2, 3, 10}, 3, 5, 3, 10, 10}};  // 2, 3, 10
    for (const auto& one : cases) {
        FrameTimes times(3);
        for (const int ms : one.ms) times.add(milliseconds(ms));
        const FrameStatistics statistics = times.statistics();
        EXPECT_EQ(statistics.count, one.count);
        EXPECT_EQ(statistics.mean_ms, one.mean);
        EXPECT_EQ(statistics.median_ms, one.median);
        EXPECT_EQ(statistics.percentile_95_ms, one.percentile_95);
        EXPECT_EQ(statistics.maximum_ms, one.maximum);
    }
}

TEST(FrameClock, FirstTickIsZeroAndLaterOnesCoverTheTimeBetween) {
    FrameClock clock;
    std::this_thread::sleep_for(2ms);
    EXPECT_EQ(clock.tick(), 0ns);
    std::this_thread::sleep_for(5ms);
    EXPECT_GE(clock.tick(), 5ms);  // the steady clock never sleeps short
}

}  // namespace
}  // namespace rowland::platform
