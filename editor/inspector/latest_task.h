#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

namespace rowland::inspector {

/// Work beside the frames of which only the newest counts: what is started while another runs waits for it, asks it to
/// stop, and takes the place of what waited before. Used from one thread, which never waits but in the destructor.
template <typename T>
class LatestTask {
 public:
    using Work = std::function<T(std::stop_token)>;

    struct Outcome {
        std::optional<T> value;  ///< nothing if it failed
        std::string failure;
    };

    LatestTask() = default;
    LatestTask(const LatestTask&) = delete;
    LatestTask& operator=(const LatestTask&) = delete;
    ~LatestTask() {
        stop_.request_stop();
        if (running_.valid()) running_.wait();
    }

    void start(Work work) {
        stop_.request_stop();
        waiting_ = std::move(work);
        if (!running_.valid()) begin();
    }

    /// What runs is asked to stop, and its outcome is dropped.
    void cancel() {
        stop_.request_stop();
        waiting_ = nullptr;
    }

    bool busy() const { return running_.valid() || waiting_ != nullptr; }

    /// Once a frame: the outcome of what has ended, if nothing newer waits and nobody cancelled it.
    std::optional<Outcome> poll() {
        if (!running_.valid() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            return std::nullopt;
        const bool stopped = stop_.stop_requested();
        std::optional<Outcome> outcome(std::in_place);
        try {
            outcome->value.emplace(running_.get());
        } catch (const std::exception& error) {
            outcome->failure = error.what();
        }
        if (waiting_) begin();
        if (stopped) outcome.reset();
        return outcome;
    }

 private:
    void begin() {
        stop_ = std::stop_source();
        running_ = std::async(std::launch::async, [work = std::exchange(waiting_, nullptr), token = stop_.get_token()] {
            return work(token);
        });
    }

    Work waiting_;
    std::stop_source stop_;
    std::future<T> running_;
};

}  // namespace rowland::inspector
