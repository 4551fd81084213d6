#include "editor/cooker/run_jobs.h"

#include <array>
#include <chrono>
#include <map>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "engine/cook/cook_record.h"
#include "engine/cook/cook_source.h"
#include "engine/cook/source_file.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"

namespace rowland::editor {

namespace {

/// Between two looks whether other processes have finished the jobs that are left.
constexpr std::chrono::milliseconds kPatience{200};

std::string hex(const std::optional<Hash128>& hash) {
    return hash ? hash->hex() : std::string();
}

/// Jobs of one process.
class Worker {
 public:
    Worker(const cook::Registry& registry, std::filesystem::path state_folder)
        : registry_(registry),
          state_folder_(std::move(state_folder)),
          // Another build of this program may cook the same sources differently.
          cooker_(hex(cook::hash_file("/proc/self/exe")) + std::string(cook::tool_version())) {
        create_folder(state_folder_);
    }

    /// nullopt if another process is doing the job.
    std::optional<JobResult> try_job(const Job& job) {
        if (is_done(job)) return JobResult::UpToDate;
        const std::optional<FileLock> lock = FileLock::try_take(state_folder_ / (job.id + ".lock"));
        if (!lock) return std::nullopt;
        if (is_done(job)) return JobResult::UpToDate;  // the lock's last owner did it
        const cook::BakedAsset baked = cook::cook_source(registry_, job.source, job.output);
        cook::write_cook_record(record_file(job), {.cooker = cooker_,
                                                   .dependencies = baked.dependencies,
                                                   .content_hash = baked.asset.header.content_hash.hex(),
                                                   .output_hash = hex(cook::hash_file(job.output))});
        return JobResult::Cooked;
    }

 private:
    std::filesystem::path record_file(const Job& job) const { return state_folder_ / (job.id + ".json"); }

    bool is_done(const Job& job) {
        const std::optional<cook::CookRecord> record = cook::read_cook_record(record_file(job));
        const cook::AssetType* type = registry_.find(job.kind);
        if (!record || type == nullptr || record->cooker != cooker_) return false;
        if (record->dependencies.empty() || record->dependencies.front() != job.source) return false;
        std::vector<Hash128> hashes;
        for (const std::filesystem::path& path : record->dependencies) {
            const std::optional<Hash128> hash = hash_of_source(path);
            if (!hash) return false;
            hashes.push_back(*hash);
        }
        return cook::content_hash(*type, hashes).hex() == record->content_hash &&
               hex(cook::hash_file(job.output)) == record->output_hash;
    }

    /// A probe that many materials name is read once, unless it changes.
    std::optional<Hash128> hash_of_source(const std::filesystem::path& path) {
        std::error_code code;
        const auto time = std::filesystem::last_write_time(path, code);
        const auto size = code ? 0 : std::filesystem::file_size(path, code);
        if (code) return std::nullopt;
        const auto found = known_.find(path);
        if (found != known_.end() && found->second.time == time && found->second.size == size)
            return found->second.hash;
        const std::optional<Hash128> hash = cook::hash_file(path);
        if (hash) known_[path] = {time, size, *hash};
        return hash;
    }

    struct Known {
        std::filesystem::file_time_type time;
        std::uintmax_t size = 0;
        Hash128 hash;
    };

    const cook::Registry& registry_;
    std::filesystem::path state_folder_;
    std::string cooker_;
    std::map<std::filesystem::path, Known> known_;
};

}  // namespace

const char* job_result_name(JobResult result) {
    constexpr std::array kNames = {"cooked", "up to date", "refused", "failed"};
    return kNames.at(static_cast<std::size_t>(result));
}

void run_jobs(const cook::Registry& registry, std::span<const Job> jobs, const std::filesystem::path& state_folder,
              const std::function<void(const Job&, JobResult, const std::string& reason)>& report) {
    Worker worker(registry, state_folder);
    Progress progress("cooking", jobs.size());
    std::vector<Job> left(jobs.begin(), jobs.end());
    while (!left.empty()) {
        std::vector<Job> taken;
        for (const Job& job : left) {
            try {
                const std::optional<JobResult> result = worker.try_job(job);
                if (!result) {
                    taken.push_back(job);
                    continue;
                }
                report(job, *result, "");
            } catch (const Error& error) {
                report(job, error.info().fault == Fault::Input ? JobResult::Refused : JobResult::Failed, error.what());
            }
            progress.advance();
        }
        left = std::move(taken);
        if (!left.empty()) std::this_thread::sleep_for(kPatience);
    }
}

}  // namespace rowland::editor
