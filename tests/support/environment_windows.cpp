#include "tests/support/environment.h"

#include <windows.h>
//
#include <psapi.h>

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

namespace {

PROCESS_MEMORY_COUNTERS_EX memory() {
    PROCESS_MEMORY_COUNTERS_EX counters{};
    GetProcessMemoryInfo(GetCurrentProcess(), reinterpret_cast<PROCESS_MEMORY_COUNTERS*>(&counters), sizeof counters);
    return counters;
}

}  // namespace

std::uint64_t peak_memory_bytes() {
    return memory().PeakWorkingSetSize;
}

std::uint64_t heap_bytes() {
    return memory().PrivateUsage;
}

void set_alarm(unsigned /*seconds*/) {}

bool has_posix_files() {
    return false;
}

bool under_wine() {
    return GetProcAddress(GetModuleHandleW(L"ntdll.dll"), "wine_get_version") != nullptr;
}

bool make_pipe(const std::filesystem::path& /*path*/) {
    return false;
}

bool make_link(const std::filesystem::path& /*target*/, const std::filesystem::path& /*link*/) {
    return false;
}

void* driver_function(const char* name) {
    if (const auto found = wglGetProcAddress(name)) return reinterpret_cast<void*>(found);
    // WGL finds no function of OpenGL 1.1.
    return reinterpret_cast<void*>(GetProcAddress(GetModuleHandleW(L"opengl32.dll"), name));
}

}  // namespace rowland::test
