#pragma once

#include <optional>
#include <string>

// What tests ask of the operating system: environment_posix.cpp, environment_windows.cpp.
namespace rowland::test {

/// Sets an environment variable of this process, or unsets it where there is no value.
void set_variable(const std::string& name, const std::optional<std::string>& value);

/// Whether every process that this one started has ended and was waited for. True where the system does not tell.
bool has_no_child();

/// The driver's own function of OpenGL, as "glFinish"; null where there is none. A context is current.
void* driver_function(const char* name);

}  // namespace rowland::test
