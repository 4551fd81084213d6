#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rowland {

/// `text` as valid UTF-8: invalid bytes, which file names may hold, become U+FFFD.
std::string valid_utf8(std::string_view text);

/// A path's text, for documents that refer to the file. Throws Error (input), with the remedy, if it is not UTF-8.
std::string require_utf8(const std::filesystem::path& path, const std::string& remedy);

}  // namespace rowland
