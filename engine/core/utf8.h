#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rowland {

/// A text for documents that must be UTF-8: bytes that are none become U+FFFD. File names may hold any.
std::string valid_utf8(std::string_view text);

/// A path's text for documents from which the file is found again. Throws Error (input), with the remedy, if it is no
/// UTF-8.
std::string require_utf8(const std::filesystem::path& path, const std::string& remedy);

}  // namespace rowland
