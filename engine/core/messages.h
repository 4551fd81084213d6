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
    std::size_t number = 0;  ///< in the order they were said
};

/// What the user was told, newest last. Each message is logged as well.
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

}  // namespace rowland
