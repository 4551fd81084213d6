#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/core/file.h"

namespace rowland::trade {

/// Hashes of the sources that results depend on, computed when the tool is built. Results of other sources are not
/// reused.
std::string reference_version();  ///< of the reference and the libraries it uses
std::string method_version();     ///< of all code that shades, on the CPU or the GPU
std::string release_version();    ///< Rowland's version number

/// Results that survive the program: a file of JSON lines, each written as soon as it is known. If the program is
/// killed, at most the last line is incomplete; it is cut off when the file is opened again.
class Journal {
 public:
    /// Reads the file, or creates it and its folder. Throws Error (input) if a complete line is no entry or another
    /// process has the file open, and Error (system) if it cannot be opened.
    explicit Journal(std::filesystem::path path);

    /// The value of a key; null if there is none.
    const nlohmann::json* find(const std::string& key) const;
    /// Writes an entry to the file. Throws Error (system).
    void add(const std::string& key, nlohmann::json value);
    std::size_t size() const { return entries_.size(); }

 private:
    std::filesystem::path path_;
    FileLock file_;
    std::map<std::string, nlohmann::json> entries_;
};

}  // namespace rowland::trade
