#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

namespace rowland {

/// A value that another thread computes from named inputs. `Key` holds the inputs; the value is current while its key
/// equals the wanted one. Used from one thread, which waits only in wait() and in the destructor.
template <typename Key, typename Value>
class Computed {
 public:
    /// Hands over an intermediate value, for poll().
    using Publish = std::function<void(Value)>;
    /// Runs on the other thread. Returns nullopt if it stopped early because the token asked for it.
    using Work = std::function<std::optional<Value>(const std::stop_token&, const Publish&)>;

    Computed() = default;
    Computed(const Computed&) = delete;
    Computed& operator=(const Computed&) = delete;
    ~Computed() {
        stop_.request_stop();
        if (running_.valid()) running_.wait();
    }

    /// States the inputs; call it every frame. If they differ from the last ones, the running work is asked to stop,
    /// and `work` starts when it has ended, unless the complete value for these inputs is there. nullopt: nothing is
    /// computed, the last value stays.
    void want(const std::optional<Key>& key, Work work) {
        if (wants(key)) return;
        stop_.request_stop();
        wanted_ = key;
        waiting_ = key && !(complete_ && key_ == key) ? std::move(work) : nullptr;
        if (!running_.valid()) begin();
    }
    bool wants(const std::optional<Key>& key) const { return wanted_ == key; }

    /// Drops the value and all work on it.
    void reset() {
        want(std::nullopt, nullptr);
        running_key_.reset();
        key_.reset();
        value_.reset();
    }

    struct Change {
        bool value = false;   ///< value() was replaced
        std::string failure;  ///< why the wanted value cannot be computed; empty: no such failure
    };
    /// Takes over what the work published or returned; call it every frame.
    Change poll() {
        Change change;
        if (!running_.valid()) return change;
        const bool ended = running_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        {
            const std::scoped_lock guard(published_->lock);
            if (published_->value) change.value = take(*std::exchange(published_->value, std::nullopt), false);
        }
        if (!ended) return change;
        try {
            if (auto value = running_.get()) change.value = take(std::move(*value), true);
        } catch (const std::exception& error) {
            if (wanted_ && wanted_ == running_key_) change.failure = error.what();
        }
        begin();
        return change;
    }

    /// Blocks until no work is left, then takes over its value.
    Change wait() {
        Change all;
        while (busy()) {
            if (running_.valid()) running_.wait();
            const Change change = poll();
            all.value = all.value || change.value;
            if (!change.failure.empty()) all.failure = change.failure;
        }
        return all;
    }

    /// The last value, current or not; null before the first.
    const Value* value() const { return value_ ? &*value_ : nullptr; }
    bool is_of(const Key& key) const { return value_ && key_ == key; }
    /// Whether value(), complete or not, is of the wanted inputs.
    bool current() const { return wanted_ && is_of(*wanted_); }
    bool busy() const { return running_.valid() || waiting_ != nullptr; }

 private:
    struct Published {
        std::mutex lock;
        std::optional<Value> value;
    };

    bool take(Value value, bool complete) {
        if (!running_key_) return false;
        value_ = std::move(value);
        key_ = running_key_;
        complete_ = complete;
        return true;
    }

    void begin() {
        if (!waiting_) return;
        stop_ = std::stop_source();
        running_key_ = wanted_;
        published_ = std::make_shared<Published>();
        const Publish publish = [published = published_](Value value) {
            const std::scoped_lock guard(published->lock);
            published->value = std::move(value);
        };
        running_ = std::async(std::launch::async, [work = std::exchange(waiting_, nullptr), publish,
                                                   token = stop_.get_token()] { return work(token, publish); });
    }

    std::optional<Key> wanted_;
    std::optional<Key> running_key_;
    std::optional<Key> key_;  ///< the inputs of value_
    std::optional<Value> value_;
    bool complete_ = false;  ///< value_ is what the work returned, not what it published before
    Work waiting_;
    std::stop_source stop_;
    std::shared_ptr<Published> published_;
    std::future<std::optional<Value>> running_;
};

}  // namespace rowland
