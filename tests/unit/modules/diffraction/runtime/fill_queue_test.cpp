// The thread that fills maps, by jobs that need no map.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "modules/diffraction/runtime/map_cache.h"

namespace rowland::diffraction {
namespace {

using Jobs = std::vector<std::shared_ptr<FillQueue::Job>>;

/// A job that counts itself.
std::function<FilledMap(const std::stop_token&)> counting(std::vector<int>& filled, int number) {
    return [&filled, number](const std::stop_token&) {
        filled.push_back(number);
        return FilledMap{};
    };
}

TEST(FillQueue, FillsOneMapAfterTheOtherInOrder) {
    std::vector<int> filled;  // by the queue's thread alone
    FillQueue queue;
    Jobs jobs;
    for (int i = 0; i < 100; ++i) jobs.push_back(queue.add(counting(filled, i)));
    queue.wait(*jobs.back(), std::nullopt);
    ASSERT_EQ(filled.size(), 100U);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(filled[static_cast<std::size_t>(i)], i);
    for (const auto& job : jobs) EXPECT_TRUE(queue.is_done(*job));
}

TEST(FillQueue, IsAskedAndWaitedForByManyThreads) {
    std::vector<int> filled;
    FillQueue queue;
    Jobs jobs;
    for (int i = 0; i < 200; ++i) jobs.push_back(queue.add(counting(filled, i)));
    std::atomic<int> seen = 0;
    {
        std::vector<std::jthread> threads;
        for (std::size_t thread = 0; thread < 4; ++thread)
            threads.emplace_back([&, thread] {
                for (std::size_t i = thread; i < jobs.size(); i += 4) {
                    while (!queue.is_done(*jobs[i])) queue.wait(*jobs[i], std::chrono::milliseconds(1));
                    seen += jobs[i]->failure.empty() ? 1 : 0;
                }
            });
    }
    EXPECT_EQ(seen, 200);
}

TEST(FillQueue, LeavesOutWhatNobodyWaitsFor) {
    std::vector<int> filled;
    std::promise<void> begin;
    const std::shared_future<void> may_begin(begin.get_future());
    FillQueue queue;
    const auto first = queue.add([&](const std::stop_token&) {
        may_begin.wait();
        return FilledMap{};
    });
    const auto stopped = queue.add(counting(filled, 1));
    const auto last = queue.add(counting(filled, 2));
    stopped->stop.request_stop();
    begin.set_value();
    queue.wait(*last, std::nullopt);
    EXPECT_TRUE(queue.is_done(*first));
    EXPECT_FALSE(queue.is_done(*stopped));
    EXPECT_EQ(filled, std::vector<int>{2});
}

TEST(FillQueue, KeepsWhyThereIsNoMap) {
    std::vector<int> filled;
    FillQueue queue;
    const auto failing = queue.add([](const std::stop_token&) -> FilledMap { throw std::runtime_error("no light"); });
    const auto after = queue.add(counting(filled, 1));
    queue.wait(*after, std::nullopt);
    EXPECT_EQ(failing->failure, "no light");
    EXPECT_EQ(after->failure, "");
}

TEST(FillQueue, WaitsNoLongerThanItIsAskedAndEndsWithAJobThatRuns) {
    std::atomic<bool> started = false;
    std::atomic<bool> ended = false;
    {
        FillQueue queue;
        const auto endless = queue.add([&](const std::stop_token& stop) {
            started = true;
            started.notify_one();
            while (!stop.stop_requested()) std::this_thread::yield();
            ended = true;
            return FilledMap{};
        });
        queue.wait(*endless, std::chrono::milliseconds(5));
        EXPECT_FALSE(queue.is_done(*endless));
        started.wait(false);
    }
    EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace rowland::diffraction
