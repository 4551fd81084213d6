#pragma once

#include <cstddef>
#include <functional>
#include <memory>

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

}  // namespace rowland
