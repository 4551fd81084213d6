#include "tests/gpu/lowered_limit.h"

#include <optional>
#include <utility>

#include "tests/support/replaced_function.h"

namespace rowland::test {

namespace {

std::optional<ReplacedFunction<&epoxy_glGetIntegerv>> integer;
std::optional<ReplacedFunction<&epoxy_glGetInteger64v>> long_integer;
std::map<GLenum, std::int64_t> lowered;

void APIENTRY get_integer(GLenum name, GLint* values) {
    if (const auto limit = lowered.find(name); limit != lowered.end())
        *values = static_cast<GLint>(limit->second);
    else
        integer->driver(name, values);
}

void APIENTRY get_long_integer(GLenum name, GLint64* values) {
    if (const auto limit = lowered.find(name); limit != lowered.end())
        *values = limit->second;
    else
        long_integer->driver(name, values);
}

}  // namespace

LoweredLimit::LoweredLimit(std::map<GLenum, std::int64_t> values) {
    lowered = std::move(values);
    integer.emplace("glGetIntegerv", get_integer);
    long_integer.emplace("glGetInteger64v", get_long_integer);
}

LoweredLimit::~LoweredLimit() {
    long_integer.reset();
    integer.reset();
}

}  // namespace rowland::test
