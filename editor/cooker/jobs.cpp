#include "editor/cooker/jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>

#include "engine/cook/cook_source.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/core/log.h"
#include "engine/core/system.h"
#include "engine/core/text.h"

namespace rowland::editor {

namespace {

constexpr std::size_t kIdDigits = 12;

bool is_hidden(const std::filesystem::path& path) {
    return path.filename().string().starts_with('.');
}

/// All files below a folder but the hidden ones.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (auto entry = std::filesystem::recursive_directory_iterator(folder);
         entry != std::filesystem::recursive_directory_iterator(); ++entry) {
        if (is_hidden(entry->path()))
            entry.disable_recursion_pending();
        else if (entry->is_regular_file())
            files.push_back(entry->path());
    }
    return files;
}

Job job_of(const cook::AssetType& type, const std::filesystem::path& source, std::filesystem::path relative,
           const std::filesystem::path& output_folder) {
    relative.replace_extension(type.extension);
    return {.id = Hasher().text(relative.generic_string()).digest().hex().substr(0, kIdDigits),
            .kind = type.name,
            .source = source,
            .output = output_folder / relative};
}

/// Sorts by output, and refuses two jobs with the same output.
void sort_jobs(std::vector<Job>& jobs) {
    std::ranges::sort(jobs, {}, &Job::output);
    for (std::size_t i = 1; i < jobs.size(); ++i)
        if (jobs[i].id == jobs[i - 1].id)
            refuse_input(
                jobs[i].source.string(), {},
                fmt::format("it becomes {}, and so does {}", jobs[i].output.string(), jobs[i - 1].source.string()),
                "a different output for each source", "name the folder that both are in, or rename one of them");
}

std::string required_text(JsonReader& reader, const std::string& key) {
    std::string text = reader.text(key);
    if (text.empty()) reader.fail(key, "an empty text", "a text");
    return text;
}

}  // namespace

std::vector<Job> plan_jobs(const cook::Registry& registry, std::span<const std::filesystem::path> sources,
                           const std::filesystem::path& output_folder) {
    std::vector<Job> jobs;
    for (const std::filesystem::path& source : sources) {
        if (std::error_code unknown; !std::filesystem::is_directory(source, unknown)) {
            read_beginning(source, 1);  // refuses what is not a readable file
            const cook::AssetType& type = registry.type_of_source(source);
            if (!type.cook)
                refuse_input(source.string(), {}, fmt::format("a {}, which is only checked, never cooked", type.name),
                             "a source that is cooked");
            jobs.push_back(job_of(type, source, source.filename(), output_folder));
            continue;
        }
        for (const std::filesystem::path& file : files_below(source)) {
            const cook::AssetType* type = registry.recognise(file);
            if (type != nullptr && type->cook)
                jobs.push_back(job_of(*type, file, file.lexically_relative(source), output_folder));
        }
    }
    if (jobs.empty())
        refuse_input(sources.empty() ? "" : sources.front().string(), {}, "nothing that can be cooked",
                     "materials, probe or mesh recipes, glTF scenes");
    sort_jobs(jobs);
    return jobs;
}

std::string job_table(std::span<const Job> jobs) {
    std::string text = "id\tkind\tsource\toutput\n";
    for (const Job& job : jobs)
        text += fmt::format("{}\t{}\t{}\t{}\n", job.id, job.kind, job.source.string(), job.output.string());
    return text;
}

std::string write_plan(std::span<const Job> jobs) {
    std::string text;
    for (const Job& job : jobs) {
        const nlohmann::ordered_json line = {{"id", job.id},
                                             {"kind", job.kind},
                                             {"source", require_utf8(job.source.generic_string(), "rename it")},
                                             {"output", require_utf8(job.output.generic_string(), "rename it")}};
        text += line.dump() + "\n";
    }
    return text;
}

std::vector<Job> parse_plan(const std::string& text, const std::string& file) {
    std::vector<Job> jobs;
    std::set<std::string> ids;
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        const std::string location = fmt::format("{}: line {}", file, ++number);
        if (!line.starts_with('{'))
            refuse_input(file, fmt::format("line {}", number), "no JSON object", "a job",
                         "write the plan with rowland-cook plan --json");
        const nlohmann::json object = parse_json(line, location);
        JsonReader reader(object, location);
        Job job{.id = required_text(reader, "id"),
                .kind = required_text(reader, "kind"),
                .source = required_text(reader, "source"),
                .output = required_text(reader, "output")};
        reader.finish();
        if (job.id.size() != kIdDigits || job.id.find_first_not_of("0123456789abcdef") != std::string::npos)
            reader.fail("id", job.id, fmt::format("{} hexadecimal digits", kIdDigits));
        if (!ids.insert(job.id).second) reader.fail("id", job.id, "an id that no line above has");
        jobs.push_back(std::move(job));
    }
    if (jobs.empty()) refuse_input(file, {}, "no jobs", "a line for each", "write it with rowland-cook plan --json");
    return jobs;
}

namespace {

/// Between two checks whether other processes have finished the remaining jobs.
constexpr std::chrono::milliseconds kPollInterval{200};

std::string hex(const std::optional<Hash128>& hash) {
    return hash ? hash->hex() : std::string();
}

/// Does the jobs of one process.
class Worker {
 public:
    Worker(const cook::Registry& registry, std::filesystem::path state_folder)
        : registry_(registry),
          state_folder_(std::move(state_folder)),
          // Another build of this program may cook the same sources differently.
          cooker_(hex(hash_file(program_file())) + std::string(cook::tool_version())) {
        create_folder(state_folder_);
    }

    /// Cooks the job's source unless it is up to date. nullopt if another process is doing the job.
    std::optional<JobResult> try_job(const Job& job) {
        if (is_done(job)) return JobResult::UpToDate;
        const std::optional<FileLock> lock = FileLock::try_take(state_folder_ / (job.id + ".lock"));
        if (!lock) return std::nullopt;
        if (is_done(job)) return JobResult::UpToDate;  // the lock's last owner did it
        const cook::BakedAsset baked = cook::cook_source(registry_, job.source, job.output);
        cook::write_cook_record(record_file(job), {.cooker = cooker_,
                                                   .dependencies = baked.dependencies,
                                                   .content_hash = baked.asset.header.content_hash.hex(),
                                                   .output_hash = hex(hash_file(job.output))});
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
               hex(hash_file(job.output)) == record->output_hash;
    }

    /// A file that many jobs depend on, such as a probe, is hashed once, unless its time or size changes.
    std::optional<Hash128> hash_of_source(const std::filesystem::path& path) {
        std::error_code code;
        const auto time = std::filesystem::last_write_time(path, code);
        const auto size = code ? 0 : std::filesystem::file_size(path, code);
        if (code) return cook::hash_dependency(path);
        const auto found = known_.find(path);
        if (found != known_.end() && found->second.time == time && found->second.size == size)
            return found->second.hash;
        const std::optional<Hash128> hash = hash_file(path);
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
        if (!left.empty()) std::this_thread::sleep_for(kPollInterval);
    }
}

}  // namespace rowland::editor
