#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace rowland {

/// Calls body(i) for i in [0, count), on all cores, and rethrows an exception of `body`. Results must not depend on the
/// order of the calls: let each i write its own slot and sum over i afterwards, in order, so that any number of threads
/// gives the same bytes.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// While it lives, parallel_for uses at most `threads` threads (0: all cores). For main programs' --threads and tests.
class ThreadLimit {
 public:
    explicit ThreadLimit(unsigned threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A value that is computed on first use, by any thread. Copies share it. If computing throws, the next use tries
/// again.
template <typename T>
class Lazy {
 public:
    Lazy(T value) : shared_(std::make_shared<Shared>()) {  // NOLINT(google-explicit-constructor): T converts to it
        shared_->value = std::move(value);
        shared_->computed = true;
    }
    explicit Lazy(std::function<T()> compute) : shared_(std::make_shared<Shared>()) {
        shared_->compute = std::move(compute);
    }

    const T& operator*() const {
        if (!shared_->computed) {
            const std::lock_guard lock(shared_->mutex);
            if (!shared_->computed) shared_->value = shared_->compute();
            shared_->computed = true;
        }
        return *shared_->value;
    }
    const T* operator->() const { return &**this; }

    bool is_computed() const { return shared_->computed; }

 private:
    // A mutex rather than std::call_once: under ThreadSanitizer the latter hangs after an exception.
    struct Shared {
        std::mutex mutex;
        std::atomic<bool> computed = false;
        std::function<T()> compute;
        std::optional<T> value;
    };
    std::shared_ptr<Shared> shared_;
};

}  // namespace rowland
