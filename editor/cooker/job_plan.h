#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/cook/registry.h"

namespace rowland::editor {

/// A source that is to be cooked, as one of many.
struct Job {
    std::string id;    ///< 12 hexadecimal digits of where the output lies below the output folder: the same in any plan
    std::string kind;  ///< the asset type's name
    std::filesystem::path source;
    std::filesystem::path output;
};

/// The jobs of files, and of folders with all that can be cooked below them; sorted by output.
/// `content/materials/cd.json` of the folder `content` becomes `<output_folder>/materials/cd.material`; a file named by
/// itself lies in the output folder. What is hidden is left out. Throws Error (input) for a file that is refused or
/// cannot be cooked, for JSON that cannot be read, if two sources become one output, and if there is no job.
std::vector<Job> plan_jobs(const cook::Registry& registry, std::span<const std::filesystem::path> sources,
                           const std::filesystem::path& output_folder);

/// A table for people: a header line, then id, kind, source and output of a job a line, parted by tabs.
std::string job_table(std::span<const Job> jobs);

/// The plan as JSON lines, a job each. Throws Error (input) for a path that is not UTF-8.
std::string write_plan(std::span<const Job> jobs);

/// Inverse of write_plan. Throws Error (input) naming `file` and the line.
std::vector<Job> parse_plan(const std::string& text, const std::string& file);

}  // namespace rowland::editor
