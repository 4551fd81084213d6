#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/hash.h"

namespace rowland::editor {

/// What a finished job leaves, so that it need not be done again: from what the output was made, by whom, and what it
/// is.
struct JobRecord {
    std::string cooker;                               ///< hash of the program
    std::vector<std::filesystem::path> dependencies;  ///< the source first
    std::string content_hash;                         ///< cook::content_hash() of them
    std::string output_hash;
};

/// Replaces the file at once. Throws Error (system).
void write_job_record(const std::filesystem::path& file, const JobRecord& record);

/// Nothing if there is no such file, or it is none: then the job is to be done.
std::optional<JobRecord> read_job_record(const std::filesystem::path& file);

}  // namespace rowland::editor
