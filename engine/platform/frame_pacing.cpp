#include "engine/platform/frame_pacing.h"

#include <algorithm>
#include <numeric>

#include "engine/core/check.h"

namespace rowland::platform {

namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

double milliseconds(std::chrono::nanoseconds time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

/// The smallest of the sorted times that at least `percent` % of them do not exceed (nearest rank).
std::chrono::nanoseconds percentile(const std::vector<std::chrono::nanoseconds>& sorted, std::size_t percent) {
    const std::size_t rank = (sorted.size() * percent + 99) / 100;
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

FixedStep::FixedStep(int steps_per_second, std::chrono::nanoseconds longest_frame)
    : steps_per_second_(steps_per_second), longest_frame_(longest_frame) {
    ROWLAND_CHECK_OP(steps_per_second, >, 0);
    ROWLAND_CHECK_OP(steps_per_second, <=, 1'000'000);
    ROWLAND_CHECK_OP(longest_frame.count(), >, 0);
    // Ten seconds of nanoseconds times the highest rate are 1e16, far below the integer's 9e18.
    ROWLAND_CHECK_OP(longest_frame.count(), <=, 10 * kNanosecondsPerSecond);
}

int FixedStep::advance(std::chrono::nanoseconds frame) {
    const auto counted = std::clamp(frame, std::chrono::nanoseconds(0), longest_frame_);
    remainder_ += counted.count() * steps_per_second_;
    const std::int64_t steps = remainder_ / kNanosecondsPerSecond;
    remainder_ -= steps * kNanosecondsPerSecond;
    return static_cast<int>(steps);
}

FrameTimes::FrameTimes(std::size_t capacity) : capacity_(capacity) {
    ROWLAND_CHECK_OP(capacity, >, std::size_t{0});
    times_.reserve(capacity);
}

void FrameTimes::add(std::chrono::nanoseconds frame) {
    if (times_.size() < capacity_)
        times_.push_back(frame);
    else
        times_[next_] = frame;
    next_ = (next_ + 1) % capacity_;
}

std::vector<float> FrameTimes::in_order_ms() const {
    std::vector<float> result;
    for (const auto time : times_) result.push_back(static_cast<float>(milliseconds(time)));
    if (times_.size() == capacity_)
        std::rotate(result.begin(), result.begin() + static_cast<std::ptrdiff_t>(next_), result.end());
    return result;
}

FrameStatistics FrameTimes::statistics() const {
    if (times_.empty()) return {};
    std::vector<std::chrono::nanoseconds> sorted = times_;
    std::sort(sorted.begin(), sorted.end());
    const auto sum = std::accumulate(sorted.begin(), sorted.end(), std::chrono::nanoseconds(0));
    return {.count = sorted.size(),
            .mean_ms = milliseconds(sum) / static_cast<double>(sorted.size()),
            .minimum_ms = milliseconds(sorted.front()),
            .median_ms = milliseconds(percentile(sorted, 50)),
            .percentile_90_ms = milliseconds(percentile(sorted, 90)),
            .percentile_95_ms = milliseconds(percentile(sorted, 95)),
            .percentile_99_ms = milliseconds(percentile(sorted, 99)),
            .maximum_ms = milliseconds(sorted.back())};
}

std::chrono::nanoseconds FrameClock::tick() {
    const Clock::time_point now = Clock::now();
    const auto frame = started_ ? now - last_ : Clock::duration(0);
    last_ = now;
    started_ = true;
    return std::chrono::duration_cast<std::chrono::nanoseconds>(frame);
}

}  // namespace rowland::platform
