#include "engine/core/log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "engine/core/system.h"

namespace rowland {

void log_line(LogLevel level, std::string_view message) {
    const char* prefix = level == LogLevel::Warning ? "warning: " : level == LogLevel::Error ? "error: " : "";
    // One write, so that lines of several threads do not interleave.
    const std::string line = fmt::format("{}{}\n", prefix, message);
    std::fwrite(line.data(), 1, line.size(), stderr);
}

namespace {

/// Nested work shows no second line.
std::atomic<bool> one_is_visible{false};

bool claim_line() {
    return error_stream_is_terminal() && !one_is_visible.exchange(true);
}

}  // namespace

Progress::Progress(std::string label, std::size_t total)
    : label_(std::move(label)), total_(std::max<std::size_t>(total, 1)), visible_(claim_line()) {}

Progress::~Progress() {
    if (visible_) one_is_visible = false;
    if (visible_ && drawn_ != Clock::time_point{}) fmt::print(stderr, "\r\033[K");
}

void Progress::advance(std::size_t steps) {
    const std::size_t done = done_ += steps;
    if (!visible_) return;
    const std::unique_lock lock(drawing_, std::try_to_lock);
    const Clock::time_point now = Clock::now();
    if (!lock.owns_lock() || now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    const double elapsed_s = std::chrono::duration<double>(now - started_).count();
    const double fraction = static_cast<double>(done) / static_cast<double>(total_);
    constexpr std::size_t kBar = 24;  // characters
    const auto filled = std::min(kBar, static_cast<std::size_t>(fraction * kBar));
    fmt::print(stderr, "\r\033[K{} [{}{}] {:3.0f} %, {:.0f} s left", label_, std::string(filled, '#'),
               std::string(kBar - filled, '.'), 100.0 * fraction, elapsed_s * (1.0 - fraction) / fraction);
    std::fflush(stderr);
}

}  // namespace rowland
