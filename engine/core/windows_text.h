#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

// Windows' own functions take UTF-16, all else here is UTF-8. Of the sources named _windows.cpp.
namespace rowland {

/// What is not UTF-8 becomes U+FFFD.
std::wstring utf16(std::string_view text);
std::string utf8(std::wstring_view text);

/// A path for Windows' functions, without their limit of 260 characters.
std::wstring long_path(const std::filesystem::path& path);

/// A program and its arguments as one text, from which CommandLineToArgvW() and the C library read them again.
std::wstring command_line(const std::filesystem::path& program, const std::vector<std::string>& arguments);

/// GetLastError(), with its text in UTF-8.
std::error_code last_windows_failure();

}  // namespace rowland
