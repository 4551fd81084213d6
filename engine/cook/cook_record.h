#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/cook/registry.h"

namespace rowland::cook {

/// The record of a finished cook, by which it is not done again: who made the output, from what, and what it is.
struct CookRecord {
    std::string cooker;                               ///< hash of the program; empty: any of this tool_version()
    std::vector<std::filesystem::path> dependencies;  ///< the source first
    std::string content_hash;                         ///< cook::content_hash() of them
    std::string output_hash;                          ///< empty: not recorded
};

/// Replaces the file as a whole. Throws Error (system).
void write_cook_record(const std::filesystem::path& file, const CookRecord& record);

/// nullopt if there is no such file or it is not a record: then the source is to be cooked.
std::optional<CookRecord> read_cook_record(const std::filesystem::path& file);

/// The cooked file of `source` in a cache: cooked now, unless a file there was cooked from the same content of the
/// source and of all its dependencies, wherever these are. `read_files` receives the dependencies, also of a source
/// that is refused. For any number of processes. Throws Error as cook_source() does.
std::filesystem::path cook_once(const Registry& registry, const std::filesystem::path& source,
                                const std::filesystem::path& cache_folder,
                                std::vector<std::filesystem::path>& read_files);

}  // namespace rowland::cook
