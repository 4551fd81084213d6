#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/log.h"

namespace rowland {

struct Message {
    std::string text;
    bool failure = false;
};

/// What the user was told, newest last. Each message is logged as well.
class Messages {
 public:
    void say(std::string text, bool failure = false) {
        constexpr std::size_t kMost = 50;
        log_line(failure ? LogLevel::Error : LogLevel::Info, text);
        messages_.push_back({std::move(text), failure});
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
};

}  // namespace rowland
