#include "editor/cooker/job_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "engine/cook/source_file.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
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

/// Refuses two jobs of one output.
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
        if (!std::filesystem::is_directory(source)) {
            cook::read_beginning(source, 1);  // refuses what is not a readable file
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
                                             {"source", require_utf8(job.source, "rename it")},
                                             {"output", require_utf8(job.output, "rename it")}};
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

}  // namespace rowland::editor
