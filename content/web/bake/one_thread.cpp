// parallel_for() and Progress of a page's worker: one thread, nothing to print on.
#include <math.h>

#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"

namespace rowland {

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
    for (std::size_t i = 0; i < count; ++i) body(i);
}

Progress::Progress(std::string, std::size_t) {}
Progress::~Progress() = default;
void Progress::advance(std::size_t) {}

void log_line(LogLevel, std::string_view) {}

}  // namespace rowland
