#pragma once

#include <cstdio>
#include <string>

namespace rowland::trade {

/// Writes results to standard output. run_program() reports a failure to write.
inline void write_results(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
}

}  // namespace rowland::trade
