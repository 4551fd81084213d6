#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace rowland {

/// One line of progress on standard error, drawn again and again: a bar, percentage and remaining time. Silent when
/// standard error is not a terminal or another Progress is shown. advance() may be called from many threads.
class Progress {
 public:
    Progress(std::string label, std::size_t total);
    ~Progress();  ///< erases the line
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void advance(std::size_t steps = 1);

 private:
    using Clock = std::chrono::steady_clock;

    std::string label_;
    std::size_t total_;
    bool visible_;
    std::atomic<std::size_t> done_{0};
    std::mutex drawing_;
    Clock::time_point started_ = Clock::now();
    Clock::time_point drawn_ = {};
};

}  // namespace rowland
