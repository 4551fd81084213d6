#include "engine/core/check.h"

#include <cstdio>
#include <cstdlib>

namespace rowland {

void check_failed(const char* file, int line, std::string_view message) {
    fmt::print(stderr, "{}:{}: contract violated: {}\n", file, line, message);
    std::abort();
}

}  // namespace rowland
