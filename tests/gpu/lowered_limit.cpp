#include "tests/gpu/lowered_limit.h"

#include <epoxy/egl.h>

#include <utility>

namespace rowland::test {

namespace {

GLenum lowered_name = GL_NONE;
std::int64_t lowered_value = 0;

void APIENTRY get_integer(GLenum name, GLint* values) {
    if (name == lowered_name)
        *values = static_cast<GLint>(lowered_value);
    else
        reinterpret_cast<PFNGLGETINTEGERVPROC>(eglGetProcAddress("glGetIntegerv"))(name, values);
}

void APIENTRY get_long_integer(GLenum name, GLint64* values) {
    if (name == lowered_name)
        *values = lowered_value;
    else
        reinterpret_cast<PFNGLGETINTEGER64VPROC>(eglGetProcAddress("glGetInteger64v"))(name, values);
}

/// Exchanges epoxy's pointers for the ones kept here: again, and all is as before.
void exchange_queries() {
    static PFNGLGETINTEGERVPROC kept = get_integer;
    static PFNGLGETINTEGER64VPROC kept_long = get_long_integer;
    std::swap(epoxy_glGetIntegerv, kept);
    std::swap(epoxy_glGetInteger64v, kept_long);
}

}  // namespace

LoweredLimit::LoweredLimit(GLenum name, std::int64_t value) {
    lowered_name = name;
    lowered_value = value;
    exchange_queries();
}

LoweredLimit::~LoweredLimit() {
    exchange_queries();
}

}  // namespace rowland::test
