#include "engine/core/parallel.h"

#ifdef __SANITIZE_THREAD__
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <optional>
#endif

namespace rowland {

#ifdef __SANITIZE_THREAD__

// The TBB library is not built for ThreadSanitizer, which would report every synchronisation inside it as a race. These
// threads are ordered by operations that it knows.

namespace {

constexpr unsigned kThreads = 4;
std::atomic<unsigned> most_threads{kThreads};

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::once_flag failed;
    const auto work = [&] {
        try {
            for (std::size_t i = next++; i < count; i = next++) body(i);
        } catch (...) {
            std::call_once(failed, [&] { failure = std::current_exception(); });
            next = count;
        }
    };
    {
        std::vector<std::jthread> others(std::min<std::size_t>(most_threads, std::max<std::size_t>(count, 1)) - 1);
        for (std::jthread& other : others) other = std::jthread(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
}

struct ThreadLimit::State {
    unsigned before = most_threads;
    ~State() { most_threads = before; }
};

ThreadLimit::ThreadLimit(unsigned threads) : state_(std::make_unique<State>()) {
    if (threads > 0) most_threads = std::min(threads, kThreads);
}

#else

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
    tbb::parallel_for(std::size_t{0}, count, body);
}

struct ThreadLimit::State {
    std::optional<tbb::global_control> control;
};

ThreadLimit::ThreadLimit(unsigned threads) : state_(std::make_unique<State>()) {
    if (threads > 0) state_->control.emplace(tbb::global_control::max_allowed_parallelism, threads);
}

#endif

ThreadLimit::~ThreadLimit() = default;

}  // namespace rowland
