#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// What the operating system tells a program about itself and its user: system_posix.cpp, system_windows.cpp. All texts
// are UTF-8.
namespace rowland {

/// The running program's file; empty where the system does not tell it, as Linux without /proc.
std::filesystem::path program_file();

/// The file of the program or shared library that holds this code; it may be a relative path, and is empty where it is
/// unknown.
std::filesystem::path code_file();

/// The program `name` in `folder`, with the extension that programs have on this system; nullopt if it is not there or
/// may not be run.
std::optional<std::filesystem::path> find_program(const std::filesystem::path& folder, const std::string& name);

/// Whether this user may create files in `folder`.
bool takes_files(const std::filesystem::path& folder);

/// The value of an environment variable; nullopt if it is not set.
std::optional<std::string> environment_variable(const std::string& name);

/// Sets an environment variable unless it is set already. No other thread may read the environment meanwhile.
void set_default_variable(const std::string& name, const std::string& value);

/// The arguments of main(). Windows gives it arguments in the user's code page, which lacks most letters; this function
/// returns the original ones.
std::vector<std::string> utf8_arguments(int argc, const char* const* argv);

/// Prepares the standard streams for bytes and UTF-8: Windows otherwise adds a carriage return to each line, and its
/// console shows another code page. Called by run_program().
void prepare_standard_streams();

/// Whether standard error is a terminal, on which a line can be drawn again.
bool error_stream_is_terminal();

/// Memory of this process that is not swapped out, in bytes; 0 where the system does not tell.
std::size_t resident_set_bytes();

// Folders of the user; nullopt where the environment names none.
std::optional<std::filesystem::path> home_folder();
std::optional<std::filesystem::path> settings_folder();  ///< ~/.config or %APPDATA%
std::optional<std::filesystem::path> cache_folder();     ///< ~/.cache or %LOCALAPPDATA%

}  // namespace rowland
