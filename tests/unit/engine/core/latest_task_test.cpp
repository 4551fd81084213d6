#include "engine/core/latest_task.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace rowland {
namespace {

/// The next outcome; fails after a minute.
template <typename T>
typename LatestTask<T>::Outcome wait_for(LatestTask<T>& task) {
    for (int i = 0; i < 60000; ++i) {
        if (auto outcome = task.poll()) return std::move(*outcome);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ADD_FAILURE() << "no outcome";
    return {};
}

TEST(LatestTask, OnlyTheNewestOfWhatWaitsIsDone) {
    LatestTask<int> task;
    std::atomic<bool> go{false};
    std::atomic<int> ran{0};
    for (int i = 1; i <= 5; ++i)
        task.start([&, i](const std::stop_token&) {
            while (!go) std::this_thread::yield();
            ++ran;
            return i;
        });
    go = true;
    EXPECT_EQ(wait_for(task).value, 5);  // the first was asked to stop, so its outcome does not count
    EXPECT_EQ(ran, 2);
    EXPECT_FALSE(task.busy());
}

TEST(LatestTask, WhatRunsIsAskedToStopByANewerOne) {
    LatestTask<int> task;
    task.start([](const std::stop_token& stop) {
        while (!stop.stop_requested()) std::this_thread::yield();
        return 1;
    });
    task.start([](const std::stop_token&) { return 2; });
    EXPECT_EQ(wait_for(task).value, 2);
}

TEST(LatestTask, AFailureIsAnOutcome) {
    LatestTask<int> task;
    task.start([](const std::stop_token&) -> int { throw std::runtime_error("no light"); });
    const auto outcome = wait_for(task);
    EXPECT_FALSE(outcome.value);
    EXPECT_EQ(outcome.failure, "no light");
}

TEST(LatestTask, WhatWasCancelledHasNoOutcome) {
    LatestTask<int> task;
    task.start([](const std::stop_token& stop) {
        while (!stop.stop_requested()) std::this_thread::yield();
        return 1;
    });
    task.cancel();
    while (task.busy()) EXPECT_FALSE(task.poll());
    EXPECT_FALSE(task.poll());
}

}  // namespace
}  // namespace rowland
