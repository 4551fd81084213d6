#pragma once
// In place of the engine's check.h. It leaves out the texts of conditions, operands and files, a fiftieth of a module.
#include <fmt/format.h>

#include <string_view>

namespace rowland {

[[noreturn]] void check_failed(const char* file, int line, std::string_view message);

}  // namespace rowland

#define ROWLAND_CHECK(condition, message)                                                                 \
    do {                                                                                                  \
        if (!(condition)) ::rowland::check_failed("", __LINE__, "a contract of this line does not hold"); \
    } while (false)
#define ROWLAND_CHECK_OP(a, op, b) ROWLAND_CHECK((a)op(b), "")
