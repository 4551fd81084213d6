#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "editor/cooker/job_plan.h"
#include "engine/cook/registry.h"

namespace rowland::editor {

/// How a job ended.
enum class JobResult {
    Cooked,
    UpToDate,  ///< this program had done it before, from the same sources
    Refused,   ///< bad input
    Failed,    ///< a failure of the system
};
const char* job_result_name(JobResult result);

/// Does jobs beside other processes that do the same, on this machine or on others that share the folders. Outputs are
/// replaced whole and do not depend on who cooks them, so a job that is done twice does no harm; locks (FileLock) and
/// records (cook::CookRecord), both in `state_folder`, save the work. Returns when each job is done or has failed here:
/// it waits for a job that another process is doing, and does it if that process ends without having done it. `report`
/// gets each job's result when it is known, with the reason where it was refused or failed.
void run_jobs(const cook::Registry& registry, std::span<const Job> jobs, const std::filesystem::path& state_folder,
              const std::function<void(const Job&, JobResult, const std::string& reason)>& report);

}  // namespace rowland::editor
