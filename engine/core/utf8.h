#pragma once

#include <string>
#include <string_view>

namespace rowland {

/// A text for documents that must be UTF-8: bytes that are none become U+FFFD. File names may hold any.
std::string valid_utf8(std::string_view text);

}  // namespace rowland
