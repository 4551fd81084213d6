#include "engine/core/computed.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace rowland {
namespace {

using Doubled = Computed<int, int>;

/// Waits until no work is left; returns all changes. Fails after a minute.
std::vector<Doubled::Change> settle(Doubled& value) {
    std::vector<Doubled::Change> changes;
    for (int i = 0; i < 60000 && value.busy(); ++i) {
        const auto change = value.poll();
        if (change.value || !change.failure.empty()) changes.push_back(change);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_FALSE(value.busy());
    return changes;
}

Doubled::Work twice(int input) {
    return [input](const std::stop_token&, const Doubled::Publish&) { return 2 * input; };
}

/// Ends only when it is asked to stop.
std::optional<int> wait_for_stop(const std::stop_token& stop, const Doubled::Publish&) {
    while (!stop.stop_requested()) std::this_thread::yield();
    return std::nullopt;
}

TEST(Computed, IsCurrentWhileItsInputsAreTheWantedOnes) {
    Doubled value;
    EXPECT_FALSE(value.current());
    value.want(4, twice(4));
    EXPECT_EQ(settle(value).size(), 1U);
    ASSERT_NE(value.value(), nullptr);
    EXPECT_EQ(*value.value(), 8);
    EXPECT_TRUE(value.current());
    value.want(5, wait_for_stop);
    EXPECT_FALSE(value.current());
    EXPECT_EQ(*value.value(), 8);  // shown until there is another
    EXPECT_TRUE(value.is_of(4));
    value.want(6, twice(6));
    settle(value);
    EXPECT_EQ(*value.value(), 12);
}

TEST(Computed, WaitEndsWithTheWantedValue) {
    Doubled value;
    EXPECT_FALSE(value.wait().value);
    value.want(5, wait_for_stop);
    value.want(6, twice(6));
    EXPECT_TRUE(value.wait().value);
    EXPECT_FALSE(value.busy());
    EXPECT_TRUE(value.current());
    EXPECT_EQ(*value.value(), 12);
    value.want(7, [](const std::stop_token&, const Doubled::Publish&) -> std::optional<int> {
        throw std::runtime_error("no 7");
    });
    EXPECT_EQ(value.wait().failure, "no 7");
}

TEST(Computed, NothingIsComputedAgainForTheSameInputs) {
    Doubled value;
    std::atomic<int> runs{0};
    const auto want = [&](int input) {
        value.want(input, [&runs, input](const std::stop_token&, const Doubled::Publish&) { return ++runs, input; });
        settle(value);
    };
    want(1);
    want(1);
    value.want(std::nullopt, nullptr);
    EXPECT_EQ(*value.value(), 1);
    want(1);
    EXPECT_TRUE(value.current());
    EXPECT_EQ(runs, 1);
    want(2);
    want(1);
    EXPECT_EQ(runs, 3);
}

TEST(Computed, OnlyTheNewestOfWhatWaitsIsComputed) {
    Doubled value;
    std::atomic<bool> go{false};
    std::atomic<int> runs{0};
    for (int i = 1; i <= 5; ++i)
        value.want(i, [&, i](const std::stop_token& stop, const Doubled::Publish&) {
            while (!go) std::this_thread::yield();
            ++runs;
            return stop.stop_requested() ? std::nullopt : std::optional(i);
        });
    go = true;
    EXPECT_EQ(settle(value).size(), 1U);
    EXPECT_EQ(*value.value(), 5);
    EXPECT_EQ(runs, 2);  // the first was running already
}

TEST(Computed, WorkThatIgnoresTheStopStillGivesTheNewerValue) {
    Doubled value;
    std::atomic<bool> go{false};
    value.want(1, [&](const std::stop_token&, const Doubled::Publish&) {
        while (!go) std::this_thread::yield();
        return 2;
    });
    value.want(2, twice(2));
    go = true;
    while (value.value() == nullptr) value.poll();
    EXPECT_EQ(*value.value(), 2);
    EXPECT_TRUE(value.is_of(1));
    EXPECT_FALSE(value.current());
    settle(value);
    EXPECT_EQ(*value.value(), 4);
}

TEST(Computed, AFailureIsReportedOnceAndTheOldValueStays) {
    Doubled value;
    value.want(1, twice(1));
    settle(value);
    value.want(2, [](const std::stop_token&, const Doubled::Publish&) -> std::optional<int> {
        throw std::runtime_error("no light");
    });
    const auto changes = settle(value);
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].failure, "no light");
    EXPECT_EQ(*value.value(), 2);
    EXPECT_FALSE(value.current());
}

TEST(Computed, AFailureForInputsThatNobodyWantsAnyMoreIsNotReported) {
    Doubled value;
    value.want(1, [](const std::stop_token& stop, const Doubled::Publish&) -> std::optional<int> {
        while (!stop.stop_requested()) std::this_thread::yield();
        throw std::runtime_error("stopped");
    });
    value.want(2, twice(2));
    for (const auto& change : settle(value)) EXPECT_EQ(change.failure, "");
    EXPECT_EQ(*value.value(), 4);
}

TEST(Computed, APublishedValueIsShownBeforeTheEndAndComputedAgainIfStopped) {
    Doubled value;
    value.want(1, [](const std::stop_token& stop, const Doubled::Publish& publish) {
        publish(1);
        return wait_for_stop(stop, publish);
    });
    while (value.value() == nullptr) value.poll();
    EXPECT_EQ(*value.value(), 1);
    EXPECT_TRUE(value.current());
    EXPECT_TRUE(value.busy());
    value.want(std::nullopt, nullptr);
    settle(value);
    EXPECT_TRUE(value.is_of(1));
    value.want(1, twice(1));  // what was stopped is incomplete
    settle(value);
    EXPECT_EQ(*value.value(), 2);
}

/// Moving one that is armed takes until another thread has begun to write, or for a while if it cannot.
struct Slow {
    struct Shared {
        std::atomic<bool> armed{false};
        std::atomic<bool> reading{false};
        std::atomic<bool> torn{false};
    };
    Shared* shared;

    explicit Slow(Shared& s) : shared(&s) {}
    Slow(Slow&& other) noexcept : shared(other.shared) {
        if (!shared->armed.exchange(false)) return;
        shared->reading = true;
        const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
        while (!shared->torn && std::chrono::steady_clock::now() < end) std::this_thread::yield();
        shared->reading = false;
    }
    Slow& operator=(Slow&& other) noexcept {
        if (shared->reading) shared->torn = true;
        shared = other.shared;
        return *this;
    }
};

TEST(Computed, NothingIsPublishedWhileAValueIsTaken) {
    Slow::Shared shared;
    std::atomic<bool> published{false};
    Computed<int, Slow> value;
    value.want(1, [&](const std::stop_token&, const Computed<int, Slow>::Publish& publish) -> std::optional<Slow> {
        publish(Slow(shared));
        published = true;
        while (!shared.reading) std::this_thread::yield();
        publish(Slow(shared));
        return std::nullopt;
    });
    while (!published) std::this_thread::yield();
    shared.armed = true;
    EXPECT_TRUE(value.poll().value);
    value.wait();
    EXPECT_FALSE(shared.torn);
}

TEST(Computed, AResetDropsTheValueAndWhatIsOnItsWay) {
    Doubled value;
    value.want(1, twice(1));
    settle(value);
    value.want(2, [](const std::stop_token& stop, const Doubled::Publish& publish) {
        publish(3);
        wait_for_stop(stop, publish);
        return std::optional(4);
    });
    value.reset();
    EXPECT_TRUE(settle(value).empty());
    EXPECT_EQ(value.value(), nullptr);
    EXPECT_FALSE(value.is_of(1));
}

}  // namespace
}  // namespace rowland
