#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace rowland {

/// Calls body(i) for i in [0, count), on all cores. Results must not depend on the order: each i writes its own slot,
/// and sums over i are taken afterwards, in order, so that any number of threads gives the same bytes.
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

/// A value that is computed on first use. Copies share it. Any thread may ask.
template <typename T>
class Lazy {
 public:
    Lazy(T value) : shared_(std::make_shared<Shared>()) {  // NOLINT(google-explicit-constructor): a T serves as one
        std::call_once(shared_->once, [&] { shared_->value = std::move(value); });
    }
    explicit Lazy(std::function<T()> compute) : shared_(std::make_shared<Shared>()) {
        shared_->compute = std::move(compute);
    }

    const T& operator*() const {
        std::call_once(shared_->once, [&] { shared_->value = shared_->compute(); });
        return *shared_->value;
    }
    const T* operator->() const { return &**this; }

    /// Not while another thread may compute it.
    bool is_computed() const { return shared_->value.has_value(); }

 private:
    struct Shared {
        std::once_flag once;
        std::function<T()> compute;
        std::optional<T> value;
    };
    std::shared_ptr<Shared> shared_;
};

}  // namespace rowland
