#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

// What tests ask of the operating system: environment_posix.cpp, environment_windows.cpp.
namespace rowland::test {

/// Sets an environment variable of this process, or unsets it where there is no value.
void set_variable(const std::string& name, const std::optional<std::string>& value);

/// Whether every process that this one started has ended and was waited for. True where the system does not tell.
bool has_no_child();

/// Most bytes of memory that this process has held at once.
std::uint64_t peak_memory_bytes();
/// Bytes of the C library's heap that somebody holds, or, where it does not tell, of the process' own memory.
std::uint64_t heap_bytes();

/// Ends this process in so many seconds, or with 0 no more; on Windows only the limit of CTest does.
void set_alarm(unsigned seconds);

/// Whether names of files are any bytes but '/', and devices are files.
bool has_posix_files();
/// Whether this is Wine, which lacks some of what Windows has.
bool under_wine();
/// Makes a named pipe; false where folders hold none.
bool make_pipe(const std::filesystem::path& path);
/// Makes a symbolic link; false where std::filesystem cannot.
bool make_link(const std::filesystem::path& target, const std::filesystem::path& link);

/// The driver's own function of OpenGL, as "glFinish"; null where there is none. A context is current.
void* driver_function(const char* name);

}  // namespace rowland::test
