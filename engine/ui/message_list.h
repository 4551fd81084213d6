#pragma once

#include <chrono>
#include <cstddef>
#include <set>
#include <span>
#include <vector>

#include "engine/core/log.h"

namespace rowland::ui {

/// Which messages the user has not read. A failure counts as read when the user closes it; all other messages are news,
/// which count as read after five seconds.
class UnreadMessages {
 public:
    using Clock = std::chrono::steady_clock;

    /// The unread ones of `all`, at most the newest four, newest last. The pointers are valid as long as `all` is.
    std::vector<const Message*> unread(std::span<const Message> all, Clock::time_point now);
    void close(const Message& message) { closed_.insert(message.number); }
    /// Whether unread() would return fewer than last time.
    bool due(Clock::time_point now) const { return !shown_.empty() && now >= shown_.front().until; }

 private:
    struct Shown {
        std::size_t number = 0;
        Clock::time_point until{};
    };

    std::vector<Shown> shown_;  ///< news that are not read yet, the oldest first
    std::set<std::size_t> closed_;
    std::size_t next_ = 0;  ///< number of the first message that was not seen yet
};

/// The unread messages in a corner of the window, failures with a button that closes them. Call between
/// Ui::begin_frame() and Ui::draw().
class MessageList {
 public:
    /// `right`, `bottom`: the list's lower right corner; `width`: its greatest width; all in screen coordinates.
    void draw(std::span<const Message> all, float right, float bottom, float width);
    /// The number of messages in the last frame.
    std::size_t shown() const { return shown_; }
    /// Whether a message disappears with the next frame, though nothing else happens.
    bool due() const { return unread_.due(UnreadMessages::Clock::now()); }

 private:
    UnreadMessages unread_;
    std::size_t shown_ = 0;
};

}  // namespace rowland::ui
