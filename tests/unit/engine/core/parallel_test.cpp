#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/parallel.h"

namespace rowland {

namespace {

TEST(Parallel, VisitsEveryIndexOnce) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{10'007}}) {
        std::vector<std::atomic<int>> visits(count);
        parallel_for(count, [&](std::size_t i) { ++visits[i]; });
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(visits[i], 1) << i;
    }
}

TEST(Parallel, ExceptionsReachTheCaller) {
    EXPECT_THROW(parallel_for(1000,
                              [](std::size_t i) {
                                  if (i == 500) throw std::out_of_range("500");
                              }),
                 std::out_of_range);
}

/// The number of distinct threads that take part in a loop long enough for all to join.
std::size_t threads_used() {
    std::mutex mutex;
    std::set<std::thread::id> threads;
    parallel_for(200, [&](std::size_t) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const std::scoped_lock lock(mutex);
        threads.insert(std::this_thread::get_id());
    });
    return threads.size();
}

TEST(Parallel, LimitOfOneRunsOnTheCallingThreadAlone) {
    const ThreadLimit limit(1);
    const std::thread::id caller = std::this_thread::get_id();
    parallel_for(1000, [&](std::size_t) { ASSERT_EQ(std::this_thread::get_id(), caller); });
}

TEST(Parallel, LimitBindsWhileItLivesAndTheSmallestWins) {
    if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one core";
    {
        const ThreadLimit two(2);
        EXPECT_LE(threads_used(), 2u);
        const ThreadLimit one(1);
        const ThreadLimit all(0);
        EXPECT_EQ(threads_used(), 1u);
    }
    // On a busy machine a second thread may come late.
    std::size_t threads = 1;
    for (int attempt = 0; attempt < 100 && threads < 2; ++attempt) threads = threads_used();
    EXPECT_GE(threads, 2u);
}

TEST(Lazy, IsComputedOnceWhenACopyIsAskedFor) {
    int computed = 0;
    const Lazy<std::string> lazy([&] {
        ++computed;
        return std::string("table");
    });
    const Lazy<std::string> copy = lazy;  // NOLINT(performance-unnecessary-copy-initialization): is tested
    EXPECT_FALSE(lazy.is_computed());
    EXPECT_EQ(*copy, "table");
    EXPECT_EQ(lazy->size(), 5);
    EXPECT_TRUE(lazy.is_computed());
    EXPECT_EQ(computed, 1);
}

TEST(Lazy, TakesAValueThatIsThere) {
    const Lazy<int> lazy(3);
    EXPECT_TRUE(lazy.is_computed());
    EXPECT_EQ(*lazy, 3);
}

TEST(Lazy, AFailureMayBeTriedAgain) {
    bool fails = true;
    const Lazy<int> lazy([&]() -> int {
        if (fails) throw 1;
        return 4;
    });
    EXPECT_THROW(*lazy, int);
    fails = false;
    EXPECT_EQ(*lazy, 4);
}

}  // namespace

}  // namespace rowland
