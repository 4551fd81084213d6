#include "editor/trade/other_load.h"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <thread>

#include "tests/support/program.h"

namespace rowland::trade {
namespace {

TEST(OtherLoad, SeesOtherProcesses) {
    const double processors = std::thread::hardware_concurrency();
    const test::Running first({"/bin/sh", "-c", "while :; do :; done"});
    const test::Running second({"/bin/sh", "-c", "while :; do :; done"});
    const OtherLoad load;
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    ASSERT_TRUE(load.fraction());
    EXPECT_GT(*load.fraction(), 0.5 * std::min(1.0, 2.0 / processors));
    EXPECT_LE(*load.fraction(), 1.0);
}

/// Two threads beside as many other processes get about half of two processors, on an idle machine all they ask for:
/// the rest is never more than what is left.
TEST(OtherLoad, DoesNotCountThisProcess) {
    const OtherLoad load;
    const auto spin = [] {
        const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(400);
        while (std::chrono::steady_clock::now() < end) {
        }
    };
    timespec before{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &before);
    const auto began = std::chrono::steady_clock::now();
    std::jthread other(spin);
    spin();
    other.join();
    timespec after{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &after);
    const double own_s =
        static_cast<double>(after.tv_sec - before.tv_sec) + 1e-9 * static_cast<double>(after.tv_nsec - before.tv_nsec);
    const double all_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count() *
                         std::thread::hardware_concurrency();
    ASSERT_TRUE(load.fraction());
    EXPECT_LT(*load.fraction(), 1.0 - own_s / all_s + 0.1);  // the system counts in steps of 10 ms
}

}  // namespace
}  // namespace rowland::trade
