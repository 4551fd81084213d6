#include "editor/cooker/cooker_program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/cooker/attach.h"
#include "editor/cooker/jobs.h"
#include "engine/command_line/command_line.h"
#include "engine/cook/cook_source.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "engine/core/program.h"
#include "engine/scene/gltf_check.h"

namespace rowland::editor {

namespace {

void add_threads_option(CLI::App& command, unsigned& threads) {
    command.add_option("--threads", threads, "Use at most N threads; 0: all cores. The result is the same")
        ->check(CLI::Range(0, 1024))
        ->type_name("N")
        ->capture_default_str();
}

void add_cook_command(CLI::App& program, const cook::Registry& registry) {
    struct Options {
        std::filesystem::path source;
        std::filesystem::path output;
        cook::CookSettings settings;
        unsigned threads = 0;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand("cook", "Cook a source: material, probe or mesh recipe, glTF scene");
    command->add_option("SOURCE", options->source, "The source file")->required();
    command->add_option("-o,--output", options->output, "The cooked file; its folder is created")->required();
    command->add_option("--depfile", options->settings.depfile, "Write the files that were read, in Makefile syntax");
    command->add_option("--parts", options->settings.parts_folder,
                        "A folder that keeps a scene's gratings, so that the next cook bakes only those that changed");
    add_threads_option(*command, options->threads);
    command->footer("Example: rowland-cook cook content/materials/cd.json -o cooked/cd.material --depfile cd.d");
    command->callback([options, &registry] {
        const ThreadLimit limit(options->threads);
        cook::cook_source(registry, options->source, options->output, options->settings);
    });
}

/// Checks all files, even after one was refused. The exit code: 1 if a file could not be checked, else 2 if one was
/// refused.
int check_all(const cook::Registry& registry, const std::vector<std::filesystem::path>& files) {
    bool refused = false;
    bool failed = false;
    for (const std::filesystem::path& file : files) {
        try {
            fmt::print("{}: {}\n", file.string(), cook::check_file(registry, file));
            std::fflush(stdout);  // in order with standard error, and kept if a later file ends the program
        } catch (const Error& error) {
            log_error("{}", error.what());
            (error.info().fault == Fault::Input ? refused : failed) = true;
        }
    }
    return failed ? 1 : refused ? 2 : 0;
}

void add_check_command(CLI::App& program, const cook::Registry& registry, int& exit_code) {
    const auto files = std::make_shared<std::vector<std::filesystem::path>>();
    CLI::App* command = program.add_subcommand("check", "Load sources or cooked assets as the engine would");
    command->add_option("FILE", *files, "glTF, GLB, .hdr, .exr, material, recipe or cooked asset")->required();
    command->footer(
        "Prints a line for each valid file on standard output and for each refused file on standard\n"
        "error; exits 2 if one was refused.\n\n"
        "Example: rowland-cook check scene.glb probe.hdr cooked/cd.material");
    command->callback([files, &registry, &exit_code] { exit_code = check_all(registry, *files); });
}

void add_info_command(CLI::App& program, const cook::Registry& registry) {
    const auto file = std::make_shared<std::filesystem::path>();
    CLI::App* command = program.add_subcommand("info", "Print what a cooked asset holds");
    command->add_option("FILE", *file, "The cooked asset")->required();
    command->footer("Example: rowland-cook info cooked/cd.material");
    command->callback([file, &registry] {
        const std::string description = cook::describe_file(registry, *file);
        fmt::print("{}{}", description, description.ends_with('\n') ? "" : "\n");
    });
}

void add_schema_command(CLI::App& program, const cook::Registry& registry) {
    std::map<std::string, std::function<nlohmann::ordered_json()>> schemas = scene::own_extension_schemas();
    for (const cook::AssetType& type : registry.types())
        if (type.schema) schemas[type.name] = type.schema;
    for (const cook::GltfExtension& extension : registry.gltf_extensions())
        if (extension.schema) schemas[extension.name] = extension.schema;
    std::vector<std::string> names;
    for (const auto& [known, schema] : schemas) names.push_back(known);
    const auto name = std::make_shared<std::string>();
    CLI::App* command = program.add_subcommand("schema", "Print the JSON Schema of a kind of source, for editors");
    command->add_option("TYPE", *name, "What the sources are cooked to, or a glTF extension")
        ->required()
        ->check(CLI::IsMember(names));
    command->footer("Example: rowland-cook schema material > material.schema.json");
    command->callback([name, schemas] { fmt::print("{}\n", schemas.at(*name)().dump(2)); });
}

/// Adds `attach`, which sets material extensions of a glTF in place.
void add_attach_command(CLI::App& program, const cook::Registry& registry) {
    CLI::App* command = program.add_subcommand("attach", "Give materials of a .gltf or .glb their gratings or films");
    const auto options = std::make_shared<AttachOptions>();
    command->add_option("SCENE", options->scene, "The scene; without -o it is replaced")->required();
    command
        ->add_option("--material", options->attached,
                     "A material, by name or as #NUMBER, and its grating or film (may be repeated)")
        ->type_name("NAME MATERIAL.json");
    command->add_option("--remove", options->removed, "Take a material's grating or film away (may be repeated)")
        ->type_name("NAME")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        ->add_option("--groove-rotation-deg", options->rotation_deg,
                     "Turn the grooves, from the tangent toward the bitangent")
        ->type_name("ANGLE");
    command
        ->add_option("--groove-texture,--thickness-texture", options->texture,
                     "An image that varies the grooves: red their direction, green their pitch; or, in green, the "
                     "film's thickness")
        ->type_name("IMAGE");
    command->add_option("-o,--output", options->output, "Write here instead");
    command->add_option("--depfile", options->depfile, "Write the files that were read, in Makefile syntax");
    command->footer(
        "Writes what is named into the file's text and nothing else: all other bytes stay. What is refused changes\n"
        "nothing. The material's own surface stays under the grating; the grating's `base` is left out, as is a\n"
        "film's `roughness`. A material has a grating or a film: the one that is attached replaces the other.\n\n"
        "Example: rowland-cook attach truck.glb --material Chrome content/materials/dvd.json -o truck_dvd.glb");
    command->callback([options, &registry] { attach(registry, *options); });
}

/// Adds `list`, which prints the material extensions of a glTF.
void add_list_command(CLI::App& program, const cook::Registry& registry, int& exit_code) {
    CLI::App* command =
        program.add_subcommand("list", "List the materials of a .gltf or .glb and what is attached to them");
    const auto scene = std::make_shared<std::filesystem::path>();
    command->add_option("SCENE", *scene, "The scene")->required();
    command->footer(
        "Prints one line per material: its number, its name, its grating or film, the meshes that use it.\n\n"
        "Example: rowland-cook list truck.glb");
    command->callback([scene, &registry, &exit_code] { exit_code = list_materials(registry, *scene); });
}

constexpr std::uint64_t kMostPlanBytes = std::uint64_t{256} << 20;

/// Adds `plan`, which lists what to cook as jobs that many workers can share.
void add_plan_command(CLI::App& program, const cook::Registry& registry) {
    struct Options {
        std::vector<std::filesystem::path> sources;
        std::filesystem::path output_folder;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand("plan", "List what is to be cooked, for many workers to share");
    command->add_option("SOURCE", options->sources, "Sources, and folders with all that can be cooked below them")
        ->required();
    command
        ->add_option("-o,--output-folder", options->output_folder,
                     "Where the cooked files go, in folders like the sources'")
        ->required();
    command->add_flag("--json", options->json, "JSON lines, which `run` reads");
    command->footer(
        "Prints one line per job: its id, its kind, its source and its output. The id depends on the output alone.\n"
        "Paths are written as given here: name them so that all workers find them.\n\n"
        "Example: rowland-cook plan content --output-folder cooked --json > plan.jsonl");
    command->callback([options, &registry] {
        const std::vector<Job> jobs = plan_jobs(registry, options->sources, options->output_folder);
        fmt::print("{}", options->json ? write_plan(jobs) : job_table(jobs));
    });
}

struct RunOptions {
    std::filesystem::path plan;
    std::vector<std::string> ids;
    bool all = false;
    std::optional<std::filesystem::path> state_folder;
    unsigned threads = 0;
};

/// The jobs of the plan that the command line names.
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

/// Throws Error (input) if a job would overwrite the plan or what another job reads or writes.
void check_jobs(const std::vector<Job>& jobs, const RunOptions& options, const std::filesystem::path& state_folder) {
    std::vector<std::filesystem::path> inputs = {options.plan};
    std::vector<Output> outputs = {{"--state", state_folder / "record"}};
    for (const Job& job : jobs) {
        inputs.push_back(job.source);
        outputs.push_back({"the output of job " + job.id, job.output});
    }
    check_outputs(inputs, outputs);
}

/// The exit code: 2 if a job's sources were refused, else 1 if a job failed otherwise.
int run_plan(const cook::Registry& registry, const RunOptions& options) {
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

/// Adds `run`, which does jobs of a plan beside other workers.
void add_run_command(CLI::App& program, const cook::Registry& registry, int& exit_code) {
    CLI::App* command = program.add_subcommand("run", "Do jobs of a plan, beside other workers on a shared folder");
    const auto options = std::make_shared<RunOptions>();
    command->add_option("--plan", options->plan, "What `plan --json` wrote")->required()->type_name("FILE");
    CLI::Option* job = command->add_option("--job", options->ids, "Do this job (may be repeated)")->type_name("ID");
    command->add_flag("--all", options->all, "Do all jobs that no worker has done or is doing")->excludes(job);
    command
        ->add_option("--state", options->state_folder,
                     "Where locks and records of finished jobs are kept (<plan>.state)")
        ->type_name("FOLDER");
    add_threads_option(*command, options->threads);
    command->footer(
        "A finished job whose sources have not changed is not done again. Any number of workers may run at once, on\n"
        "any machines that see the same folders. If one is killed, another one does its job. Ends when every job is\n"
        "done. Prints one line per job: its id, the result, its output.\n\n"
        "Example: rowland-cook run --plan plan.jsonl --all");
    command->callback([options, &registry, &exit_code] { exit_code = run_plan(registry, *options); });
}

}  // namespace

int run_cooker(int argc, const char* const* argv, const cook::Registry& registry,
               std::initializer_list<AddCommand> more) {
    return run_program([&] {
        int exit_code = 0;
        CLI::App program("Turns sources into the cooked assets that Rowland loads, and checks both.", "rowland-cook");
        program.require_subcommand(1);
        program.footer(
            "Exit codes: 0 success, 2 bad input or usage, 1 any other failure.\n\n"
            "Example: rowland-cook check content/materials/*.json");
        add_cook_command(program, registry);
        add_check_command(program, registry, exit_code);
        add_info_command(program, registry);
        add_schema_command(program, registry);
        add_attach_command(program, registry);
        add_list_command(program, registry, exit_code);
        add_plan_command(program, registry);
        add_run_command(program, registry, exit_code);
        for (const AddCommand add : more) add(program);
        parse_command_line(program, argc, argv);
        return exit_code;
    });
}

}  // namespace rowland::editor
