#include "engine/core/log.h"

#include <cstdio>
#include <string>

namespace rowland {

void log_line(LogLevel level, std::string_view message) {
    const char* prefix = level == LogLevel::Warning ? "warning: " : level == LogLevel::Error ? "error: " : "";
    // One write, so that lines of several threads do not interleave.
    const std::string line = fmt::format("{}{}\n", prefix, message);
    std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace rowland
