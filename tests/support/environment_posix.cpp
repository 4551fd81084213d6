#include "tests/support/environment.h"

#include <epoxy/egl.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdlib>

namespace rowland::test {

void set_variable(const std::string& name, const std::optional<std::string>& value) {
    if (value)
        ::setenv(name.c_str(), value->c_str(), 1);
    else
        ::unsetenv(name.c_str());
}

bool has_no_child() {
    return ::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD;
}

void* driver_function(const char* name) {
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

}  // namespace rowland::test
