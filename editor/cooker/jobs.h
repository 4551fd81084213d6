#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/cook/registry.h"

namespace rowland::editor {

/// A source to be cooked, as one of many.
struct Job {
    std::string id;    ///< 12 hexadecimal digits: a hash of the output's path below the output folder
    std::string kind;  ///< the asset type's name
    std::filesystem::path source;
    std::filesystem::path output;
};

/// The jobs of source files, and of all files below source folders that can be cooked; sorted by output.
/// `content/materials/cd.json` of the folder `content` becomes `<output_folder>/materials/cd.material`; a source file
/// goes directly into the output folder. Hidden files and folders are left out. Throws Error (input) for a file that is
/// refused or cannot be cooked, for JSON that cannot be read, if two sources become one output, and if there is no job.
std::vector<Job> plan_jobs(const cook::Registry& registry, std::span<const std::filesystem::path> sources,
                           const std::filesystem::path& output_folder);

/// A table for people: a header line, then a line per job with its id, kind, source and output between tabs.
std::string job_table(std::span<const Job> jobs);

/// The plan as JSON lines, one per job. Throws Error (input) for a path that is not UTF-8.
std::string write_plan(std::span<const Job> jobs);

/// Inverse of write_plan. Throws Error (input) naming `file` and the line.
std::vector<Job> parse_plan(const std::string& text, const std::string& file);

/// How a job ended.
enum class JobResult {
    Cooked,
    UpToDate,  ///< already cooked by this version from the same sources
    Refused,   ///< bad input
    Failed,    ///< a failure of the system
};
const char* job_result_name(JobResult result);

/// Runs jobs concurrently with other processes that run the same plan, on this machine or on others that share the
/// folders. Outputs are replaced atomically and do not depend on who cooks them, so running a job twice is harmless;
/// locks (FileLock) and records (cook::CookRecord), both in `state_folder`, avoid it. Returns when each job is done or
/// has failed here: it waits for a job that another process runs, and runs it if that process ends without a result.
/// `report` gets each job's result when it is known, with the reason where it was refused or failed.
void run_jobs(const cook::Registry& registry, std::span<const Job> jobs, const std::filesystem::path& state_folder,
              const std::function<void(const Job&, JobResult, const std::string& reason)>& report);

}  // namespace rowland::editor
