#include "editor/cooker/cooker_program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/cooker/farm_commands.h"
#include "engine/cook/check_file.h"
#include "engine/cook/cook_source.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "engine/core/program.h"

namespace rowland::editor {

namespace {

struct Arguments {
    std::string source;
    std::string output;
    std::string depfile;
    unsigned threads = 0;
    std::vector<std::string> checked_files;
    std::string described_file;
    PlanCommand plan;
    RunCommand run;
};

/// The command line's grammar and help.
struct Grammar {
    CLI::App app{"Turns sources into the cooked assets that Rowland loads, and checks both."};
    CLI::App* cook = app.add_subcommand("cook", "Cook a source: material, probe recipe, mesh recipe");
    CLI::App* check = app.add_subcommand("check", "Load sources or cooked assets as the engine would");
    CLI::App* info = app.add_subcommand("info", "Print what a cooked asset holds");
    CLI::App* plan = nullptr;
    CLI::App* run = nullptr;

    explicit Grammar(Arguments& arguments) {
        app.name("rowland-cook");
        app.set_version_flag("--version", fmt::format("rowland-cook {}", cook::tool_version()));
        app.require_subcommand(1);
        app.footer(
            "Exit codes: 0 success, 2 bad input or usage, 1 any other failure.\n\n"
            "Example: rowland-cook check content/materials/*.json");

        cook->add_option("SOURCE", arguments.source, "The source file")->required();
        cook->add_option("-o,--output", arguments.output, "The cooked file; its folder is created")->required();
        cook->add_option("--depfile", arguments.depfile, "Write what the output was made from, in Makefile syntax");
        cook->add_option("--threads", arguments.threads, "Use at most N threads; 0: all cores. The result is the same")
            ->check(CLI::Range(0, 1024))
            ->type_name("N")
            ->capture_default_str();
        cook->footer("Example: rowland-cook cook content/materials/cd.json -o cooked/cd.material --depfile cd.d");

        check->add_option("FILE", arguments.checked_files, "glTF, GLB, .hdr, .exr, material, recipe or cooked asset")
            ->required();
        check->footer(
            "Prints a line for each sane file on standard output and for each refused file on standard\n"
            "error; exits 2 if one was refused.\n\n"
            "Example: rowland-cook check scene.glb probe.hdr cooked/cd.material");

        info->add_option("FILE", arguments.described_file, "The cooked asset")->required();
        info->footer("Example: rowland-cook info cooked/cd.material");

        plan = arguments.plan.declare(app);
        run = arguments.run.declare(app);
    }
};

int cook_one(const cook::Registry& registry, const Arguments& arguments) {
    const ThreadLimit limit(arguments.threads);
    cook::CookSettings settings;
    if (!arguments.depfile.empty()) settings.depfile = arguments.depfile;
    cook::cook_source(registry, arguments.source, arguments.output, settings);
    return 0;
}

/// Checks all files even after a refusal.
int check_all(const cook::Registry& registry, const std::vector<std::string>& files) {
    bool refused = false;
    bool failed = false;
    for (const std::string& file : files) {
        try {
            fmt::print("{}: {}\n", file, cook::check_file(registry, file));
            std::fflush(stdout);  // in step with standard error, and kept if a later file should end us
        } catch (const Error& error) {
            log_error("{}", error.what());
            (error.info().fault == Fault::Input ? refused : failed) = true;
        }
    }
    return failed ? 1 : refused ? 2 : 0;
}

int describe_one(const cook::Registry& registry, const std::string& file) {
    std::string description = cook::describe_file(registry, file);
    if (!description.ends_with('\n')) description += '\n';
    fmt::print("{}", description);
    return 0;
}

}  // namespace

int run_cooker(int argc, const char* const* argv, const cook::Registry& registry) {
    return run_program([&] {
        Arguments arguments;
        Grammar grammar(arguments);
        try {
            grammar.app.parse(argc, argv);
        } catch (const CLI::ParseError& error) {
            return grammar.app.exit(error) == 0 ? 0 : 2;
        }
        if (grammar.plan->parsed()) return arguments.plan.run(registry);
        if (grammar.run->parsed()) return arguments.run.run(registry);
        if (grammar.cook->parsed()) return cook_one(registry, arguments);
        if (grammar.check->parsed()) return check_all(registry, arguments.checked_files);
        return describe_one(registry, arguments.described_file);
    });
}

}  // namespace rowland::editor
