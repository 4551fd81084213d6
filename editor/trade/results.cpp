#include "editor/trade/results.h"

#include <cstdio>

#include "engine/core/error.h"

namespace rowland::trade {

void write_results(const std::string& text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0)
        throw Error({.file = "standard output",
                     .place = {},
                     .found = "a write error",
                     .expected = {},
                     .remedy = "is the disk full?",
                     .fault = Fault::System});
}

}  // namespace rowland::trade
