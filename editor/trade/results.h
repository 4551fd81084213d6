#pragma once

#include <string>

namespace rowland::trade {

/// Writes results to standard output. Throws Error (system) if they cannot be written in full.
void write_results(const std::string& text);

}  // namespace rowland::trade
