#include "editor/cooker/farm_commands.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/cooker/job_plan.h"
#include "editor/cooker/run_jobs.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/parallel.h"

namespace rowland::editor {

namespace {

constexpr std::uint64_t kMostPlanBytes = std::uint64_t{256} << 20;

struct PlanOptions {
    std::vector<std::filesystem::path> sources;
    std::filesystem::path output_folder;
    bool json = false;
};

struct RunOptions {
    std::filesystem::path plan;
    std::vector<std::string> ids;
    bool all = false;
    std::optional<std::filesystem::path> state_folder;
    unsigned threads = 0;
};

void plan(const cook::Registry& registry, const PlanOptions& options) {
    const std::vector<Job> jobs = plan_jobs(registry, options.sources, options.output_folder);
    fmt::print("{}", options.json ? write_plan(jobs) : job_table(jobs));
}

std::vector<Job> chosen_jobs(const RunOptions& options) {
    std::vector<Job> jobs = parse_plan(read_text_file(options.plan, kMostPlanBytes), options.plan.string());
    if (options.all) return jobs;
    std::vector<Job> result;
    for (const std::string& id : options.ids) {
        const auto job = std::ranges::find(jobs, id, &Job::id);
        if (job == jobs.end())
            refuse_input("--job", id, "no job of " + options.plan.string(), "an id of the plan's first column");
        result.push_back(*job);
    }
    return result;
}

/// No job may overwrite the plan or what another job reads or writes.
void check_jobs(const std::vector<Job>& jobs, const RunOptions& options, const std::filesystem::path& state_folder) {
    std::vector<std::filesystem::path> inputs = {options.plan};
    std::vector<Output> outputs = {{"--state", state_folder / "record"}};
    for (const Job& job : jobs) {
        inputs.push_back(job.source);
        outputs.push_back({"the output of job " + job.id, job.output});
    }
    check_outputs(inputs, outputs);
}

int run(const cook::Registry& registry, const RunOptions& options) {
    if (options.all == !options.ids.empty())
        refuse_input("--job, --all", {}, options.all ? "both" : "neither", "one of them",
                     "see rowland-cook run --help");
    const ThreadLimit limit(options.threads);
    const std::filesystem::path state_folder = options.state_folder.value_or(options.plan.string() + ".state");
    const std::vector<Job> jobs = chosen_jobs(options);
    check_jobs(jobs, options, state_folder);
    bool refused = false;
    bool failed = false;
    fmt::print("id\tresult\toutput\n");
    run_jobs(registry, jobs, state_folder, [&](const Job& job, JobResult result, const std::string& reason) {
        if (!reason.empty()) log_error("{}", reason);
        refused = refused || result == JobResult::Refused;
        failed = failed || result == JobResult::Failed;
        fmt::print("{}\t{}\t{}\n", job.id, job_result_name(result), job.output.string());
        std::fflush(stdout);  // so that the line is kept if the program is killed
    });
    return refused ? 2 : failed ? 1 : 0;
}

}  // namespace

void add_threads_option(CLI::App& command, unsigned& threads) {
    command.add_option("--threads", threads, "Use at most N threads; 0: all cores. The result is the same")
        ->check(CLI::Range(0, 1024))
        ->type_name("N")
        ->capture_default_str();
}

void add_farm_commands(CLI::App& program, const cook::Registry& registry, int& exit_code) {
    CLI::App* command = program.add_subcommand("plan", "List what is to be cooked, for many workers to share");
    const auto planned = std::make_shared<PlanOptions>();
    command->add_option("SOURCE", planned->sources, "Sources, and folders with all that can be cooked below them")
        ->required();
    command
        ->add_option("-o,--output-folder", planned->output_folder,
                     "Where the cooked files go, in folders like the sources'")
        ->required();
    command->add_flag("--json", planned->json, "JSON lines, which `run` reads");
    command->footer(
        "Prints one line per job: its id, its kind, its source and its output. The id depends on the output alone.\n"
        "Paths are written as given here: name them so that all workers find them.\n\n"
        "Example: rowland-cook plan content --output-folder cooked --json > plan.jsonl");
    command->callback([planned, &registry] { plan(registry, *planned); });

    command = program.add_subcommand("run", "Do jobs of a plan, beside other workers on a shared folder");
    const auto running = std::make_shared<RunOptions>();
    command->add_option("--plan", running->plan, "What `plan --json` wrote")->required()->type_name("FILE");
    CLI::Option* job = command->add_option("--job", running->ids, "Do this job (may be repeated)")->type_name("ID");
    command->add_flag("--all", running->all, "Do all jobs that no worker has done or is doing")->excludes(job);
    command
        ->add_option("--state", running->state_folder,
                     "Where locks and records of finished jobs are kept (<plan>.state)")
        ->type_name("FOLDER");
    add_threads_option(*command, running->threads);
    command->footer(
        "A finished job whose sources have not changed is not done again. Any number of workers may run at once, on\n"
        "any machines that see the same folders. If one is killed, another one does its job. Ends when every job is\n"
        "done. Prints one line per job: its id, the result, its output.\n\n"
        "Example: rowland-cook run --plan plan.jsonl --all");
    command->callback([running, &registry, &exit_code] { exit_code = run(registry, *running); });
}

}  // namespace rowland::editor
