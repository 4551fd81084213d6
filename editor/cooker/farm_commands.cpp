#include "editor/cooker/farm_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "editor/cooker/job_plan.h"
#include "editor/cooker/run_jobs.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/parallel.h"

namespace rowland::editor {

namespace {

constexpr std::uint64_t kMostPlanBytes = std::uint64_t{256} << 20;

std::vector<Job> chosen(std::vector<Job> jobs, const RunCommand& command) {
    if (command.all) return jobs;
    std::vector<Job> result;
    for (const std::string& id : command.ids) {
        const auto job = std::ranges::find(jobs, id, &Job::id);
        if (job == jobs.end())
            refuse_input("--job", id, "no job of " + command.plan.string(), "an id of the plan's first column");
        result.push_back(*job);
    }
    return result;
}

}  // namespace

CLI::App* PlanCommand::declare(CLI::App& program) {
    CLI::App* command = program.add_subcommand("plan", "List what is to be cooked, for many workers to share");
    command->add_option("SOURCE", sources, "Sources, and folders with all that can be cooked below them")->required();
    command->add_option("-o,--output-folder", output_folder, "Where the cooked files go, in the sources' folders")
        ->required();
    command->add_flag("--json", json, "JSON lines, which `run` reads");
    command->footer(
        "Prints a job a line: its id, which is the same in any plan that has its output, its kind, source and output.\n"
        "Paths are written as given here: name them so that all workers find them.\n\n"
        "Example: rowland-cook plan content --output-folder cooked --json > plan.jsonl");
    return command;
}

int PlanCommand::run(const cook::Registry& registry) const {
    const std::vector<Job> jobs = plan_jobs(registry, sources, output_folder);
    fmt::print("{}", json ? write_plan(jobs) : job_table(jobs));
    return 0;
}

CLI::App* RunCommand::declare(CLI::App& program) {
    CLI::App* command = program.add_subcommand("run", "Do jobs of a plan, beside other workers on a shared folder");
    command->add_option("--plan", plan, "What `plan --json` wrote")->required()->type_name("FILE");
    CLI::Option* job = command->add_option("--job", ids, "Do this job (may be repeated)")->type_name("ID");
    command->add_flag("--all", all, "Do all jobs that nobody has done or is doing")->excludes(job);
    command->add_option("--state", state_folder, "Where locks and records of finished jobs are kept (<plan>.state)")
        ->type_name("FOLDER");
    command->add_option("--threads", threads, "Use at most N threads; 0: all cores. The result is the same")
        ->check(CLI::Range(0, 1024))
        ->type_name("N")
        ->capture_default_str();
    command->footer(
        "A finished job whose sources are as they were is not done again. Any number of workers may run at once, on "
        "any\n"
        "machines that see the same folders; one that is killed costs the job it was at, which another one does. Ends\n"
        "when every job is done. Prints a line a job: its id, what became of it, its output.\n\n"
        "Example: rowland-cook run --plan plan.jsonl --all");
    return command;
}

int RunCommand::run(const cook::Registry& registry) const {
    if (all == !ids.empty())
        refuse_input("--job, --all", {}, all ? "both" : "neither", "one of them", "see rowland-cook run --help");
    const ThreadLimit limit(threads);
    const std::vector<Job> jobs = chosen(parse_plan(read_text_file(plan, kMostPlanBytes), plan.string()), *this);
    bool refused = false;
    bool failed = false;
    fmt::print("id\tresult\toutput\n");
    const auto report = [&](const Job& job, JobResult result, const std::string& reason) {
        if (!reason.empty()) log_error("{}", reason);
        refused = refused || result == JobResult::Refused;
        failed = failed || result == JobResult::Failed;
        fmt::print("{}\t{}\t{}\n", job.id, job_result_name(result), job.output.string());
        std::fflush(stdout);  // kept if we should be killed
    };
    run_jobs(registry, jobs, state_folder.value_or(plan.string() + ".state"), report);
    return refused ? 2 : failed ? 1 : 0;
}

}  // namespace rowland::editor
