#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

namespace rowland {

/// Background work of which only the newest counts: a start while another work runs asks that one to stop, waits for
/// its end, and replaces what waited before. Used from one thread, which blocks in the destructor only.
template <typename T>
class LatestTask {
 public:
    using Work = std::function<T(std::stop_token)>;

    struct Outcome {
        std::optional<T> value;  ///< nullopt if it failed
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

    /// Asks the running work to stop and drops its outcome.
    void cancel() {
        stop_.request_stop();
        waiting_ = nullptr;
    }

    bool busy() const { return running_.valid() || waiting_ != nullptr; }

    /// To be called once per frame: the outcome of work that has ended, unless it was cancelled or newer work waits.
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

}  // namespace rowland
