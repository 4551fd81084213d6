#include "engine/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <optional>

namespace rowland {

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
    tbb::parallel_for(std::size_t{0}, count, body);
}

struct ThreadLimit::State {
    std::optional<tbb::global_control> control;
};

ThreadLimit::ThreadLimit(unsigned threads) : state_(std::make_unique<State>()) {
    if (threads > 0) state_->control.emplace(tbb::global_control::max_allowed_parallelism, threads);
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace rowland
