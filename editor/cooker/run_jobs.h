#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "editor/cooker/job_plan.h"
#include "engine/cook/registry.h"

namespace rowland::editor {

/// What became of a job.
enum class JobResult {
    Cooked,
    UpToDate,  ///< it had been done, by this program, from these sources
    Refused,   ///< bad input
    Failed,    ///< the system did not let us
};
const char* job_result_name(JobResult result);

/// Does jobs beside other processes that do the same, on this machine or on others that share the folders. Outputs are
/// replaced whole, and are the same bytes whoever cooks them, so that two who do one job do no harm; locks (JobLock)
/// and records, both in `state_folder`, only save the work. Does not return before each job is done or has failed here:
/// one that another process has begun is waited for, and done here if that process ends without having done it.
/// `report` is told of each job's result, with the reason where there is none, as they come.
void run_jobs(const cook::Registry& registry, std::span<const Job> jobs, const std::filesystem::path& state_folder,
              const std::function<void(const Job&, JobResult, const std::string& reason)>& report);

}  // namespace rowland::editor
