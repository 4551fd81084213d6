#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rowland::fuzz {

/// A format that files from anywhere come in.
struct Format {
    const char* name;
    /// Reads bytes as the engine would, and looks at all that it got. Throws Error (input) if they are refused.
    void (*read)(std::span<const std::byte> bytes);
    std::vector<const char*> extensions;  ///< of files that may be of it
};

const std::vector<Format>& formats();

/// Throws std::out_of_range for an unknown name.
const Format& format(const std::string& name);

/// Reads; false if the bytes are refused by an Error (input) of one line. Whatever else is thrown goes on, and a value
/// that breaks what its type promises aborts.
bool accepts(const Format& format, std::span<const std::byte> bytes);

}  // namespace rowland::fuzz
