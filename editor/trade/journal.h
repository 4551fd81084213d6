#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace rowland::trade {

/// Results that survive the program: a file of JSON lines, each written as soon as it is known. Whatever kills the
/// program, a line is whole or was the last; a torn last line is cut off when the file is opened again.
class Journal {
 public:
    /// Reads what is there; creates the folder and the file if need be. Throws Error (input) if a line other than the
    /// last is no entry or another process has the file open, and Error (system) if it cannot be opened.
    explicit Journal(std::filesystem::path path);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// The value under a key; null if there is none.
    const nlohmann::json* find(const std::string& key) const;
    /// Writes an entry out. Throws Error (system).
    void add(const std::string& key, nlohmann::json value);
    std::size_t size() const { return entries_.size(); }

 private:
    struct File;
    void read();

    std::filesystem::path path_;
    std::unique_ptr<File> file_;
    std::map<std::string, nlohmann::json> entries_;
};

}  // namespace rowland::trade
