#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/hash.h"

namespace rowland::editor {

/// The record of a finished job, by which it is not done again: who made the output, from what, and what it is.
struct JobRecord {
    std::string cooker;                               ///< hash of the program
    std::vector<std::filesystem::path> dependencies;  ///< the source first
    std::string content_hash;                         ///< cook::content_hash() of them
    std::string output_hash;
};

/// Replaces the file as a whole. Throws Error (system).
void write_job_record(const std::filesystem::path& file, const JobRecord& record);

/// nullopt if there is no such file or it is not a record: then the job is to be done.
std::optional<JobRecord> read_job_record(const std::filesystem::path& file);

}  // namespace rowland::editor
