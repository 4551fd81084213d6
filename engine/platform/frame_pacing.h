#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rowland::platform {

/// Divides the time of uneven frames into equal steps, so that a simulation runs the same at any frame rate. Counts in
/// integers: the number of steps depends on the sum of the frame times alone, never on its split or rounding (unless a
/// frame is clamped, see the constructor).
class FixedStep {
 public:
    /// `steps_per_second` in 1 to 1 000 000. Frame times are clamped to `longest_frame` (> 0, at most 10 s), so that
    /// the simulation does not try to catch up after a breakpoint or a slow load.
    explicit FixedStep(int steps_per_second = 120,
                       std::chrono::nanoseconds longest_frame = std::chrono::milliseconds(250));

    /// Adds a frame's time and returns how many steps to simulate now. A negative time counts as none.
    int advance(std::chrono::nanoseconds frame);

 private:
    std::int64_t steps_per_second_;
    std::chrono::nanoseconds longest_frame_;
    std::int64_t remainder_ = 0;  ///< time not simulated yet, in nanoseconds times steps_per_second_
};

/// Times in milliseconds. Median and percentiles by nearest rank, so each is a time that occurred.
struct FrameStatistics {
    std::size_t count = 0;
    double mean_ms = 0.0;
    double minimum_ms = 0.0;
    double median_ms = 0.0;
    double percentile_90_ms = 0.0;
    double percentile_95_ms = 0.0;
    double percentile_99_ms = 0.0;
    double maximum_ms = 0.0;
};

/// The times of the last `capacity` frames.
class FrameTimes {
 public:
    explicit FrameTimes(std::size_t capacity = 240);  ///< > 0

    void add(std::chrono::nanoseconds frame);
    /// Milliseconds, the last frame last.
    std::vector<float> in_order_ms() const;
    /// All zero before the first frame.
    FrameStatistics statistics() const;

 private:
    std::vector<std::chrono::nanoseconds> times_;
    std::size_t capacity_;
    std::size_t next_ = 0;
};

/// Measures frames with the steady clock.
class FrameClock {
 public:
    /// Time since the last call; zero on the first, so that loading is not a frame.
    std::chrono::nanoseconds tick();

 private:
    using Clock = std::chrono::steady_clock;

    Clock::time_point last_ = {};
    bool started_ = false;
};

}  // namespace rowland::platform
