#include "tests/gpu/lowered_limit.h"

#include <optional>

#include "tests/support/replaced_function.h"

namespace rowland::test {

namespace {

std::optional<ReplacedFunction<&epoxy_glGetIntegerv>> integer;
std::optional<ReplacedFunction<&epoxy_glGetInteger64v>> long_integer;
GLenum lowered_name = GL_NONE;
std::int64_t lowered_value = 0;

void APIENTRY get_integer(GLenum name, GLint* values) {
    if (name == lowered_name)
        *values = static_cast<GLint>(lowered_value);
    else
        integer->driver(name, values);
}

void APIENTRY get_long_integer(GLenum name, GLint64* values) {
    if (name == lowered_name)
        *values = lowered_value;
    else
        long_integer->driver(name, values);
}

}  // namespace

LoweredLimit::LoweredLimit(GLenum name, std::int64_t value) {
    lowered_name = name;
    lowered_value = value;
    integer.emplace("glGetIntegerv", get_integer);
    long_integer.emplace("glGetInteger64v", get_long_integer);
}

LoweredLimit::~LoweredLimit() {
    long_integer.reset();
    integer.reset();
}

}  // namespace rowland::test
