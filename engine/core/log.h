#pragma once

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rowland {

enum class LogLevel { Info, Warning, Error };

/// Writes one line to standard error; standard output is for results only.
void log_line(LogLevel level, std::string_view message);

template <typename... Args>
void log_info(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::Info, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args>
void log_warning(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::Warning, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args>
void log_error(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::Error, fmt::format(format, std::forward<Args>(args)...));
}

struct Message {
    std::string text;
    bool failure = false;
    std::size_t number = 0;  ///< 0 for the first message, 1 for the second, …
};

/// The last 50 messages to the user, newest last. Each is logged as well.
class Messages {
 public:
    void say(std::string text, bool failure = false) {
        log_line(failure ? LogLevel::Error : LogLevel::Info, text);
        add_logged(std::move(text), failure);
    }
    /// The same for a message that was logged already.
    void add_logged(std::string text, bool failure) {
        constexpr std::size_t kMost = 50;
        messages_.push_back({std::move(text), failure, said_++});
        if (messages_.size() > kMost) messages_.erase(messages_.begin());
    }
    /// Runs an action; an exception becomes a message. Returns whether there was none.
    template <typename Action>
    bool attempt(Action&& action) {
        try {
            action();
            return true;
        } catch (const std::exception& error) {
            say(error.what(), true);
            return false;
        }
    }
    const std::vector<Message>& all() const { return messages_; }

 private:
    std::vector<Message> messages_;
    std::size_t said_ = 0;
};

/// One line of progress on standard error, redrawn as work advances: a bar, percentage and remaining time. Silent when
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
