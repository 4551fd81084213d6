#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace rowland {

/// Prints the violated contract and aborts.
[[noreturn]] inline void check_failed(const char* file, int line, std::string_view message) {
    fmt::print(stderr, "{}:{}: contract violated: {}\n", file, line, message);
    std::abort();
}

}  // namespace rowland

/// Contract: aborts with both operands if it does not hold. Checked in every build.
#define ROWLAND_CHECK_OP(a, op, b)                                                                      \
    do {                                                                                                \
        const auto& rowland_check_a = (a);                                                              \
        const auto& rowland_check_b = (b);                                                              \
        if (!(rowland_check_a op rowland_check_b))                                                      \
            ::rowland::check_failed(                                                                    \
                __FILE__, __LINE__,                                                                     \
                fmt::format("{} {} {} with {} and {}", #a, #op, #b, rowland_check_a, rowland_check_b)); \
    } while (false)

/// Contract with a message that states what was violated.
#define ROWLAND_CHECK(condition, message)                                         \
    do {                                                                          \
        if (!(condition)) ::rowland::check_failed(__FILE__, __LINE__, (message)); \
    } while (false)
