#include "tests/support/environment.h"

#include <windows.h>

#include <cstdlib>

#include "engine/core/windows_text.h"

namespace rowland::test {

void set_variable(const std::string& name, const std::optional<std::string>& value) {
    // An empty value unsets the variable.
    _wputenv_s(utf16(name).c_str(), utf16(value.value_or("")).c_str());
}

bool has_no_child() {
    return true;
}

void* driver_function(const char* name) {
    if (const auto found = wglGetProcAddress(name)) return reinterpret_cast<void*>(found);
    // WGL finds no function of OpenGL 1.1.
    return reinterpret_cast<void*>(GetProcAddress(GetModuleHandleW(L"opengl32.dll"), name));
}

}  // namespace rowland::test
