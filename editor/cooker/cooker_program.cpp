#include "editor/cooker/cooker_program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "editor/cooker/attach_command.h"
#include "editor/cooker/farm_commands.h"
#include "engine/cook/check_file.h"
#include "engine/cook/cook_source.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "engine/core/program.h"

namespace rowland::editor {

namespace {

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
    add_threads_option(*command, options->threads);
    command->footer("Example: rowland-cook cook content/materials/cd.json -o cooked/cd.material --depfile cd.d");
    command->callback([options, &registry] {
        const ThreadLimit limit(options->threads);
        cook::cook_source(registry, options->source, options->output, options->settings);
    });
}

/// Checks all files, also after a refusal. Returns the exit code.
int check_all(const cook::Registry& registry, const std::vector<std::filesystem::path>& files) {
    bool refused = false;
    bool failed = false;
    for (const std::filesystem::path& file : files) {
        try {
            fmt::print("{}: {}\n", file.string(), cook::check_file(registry, file));
            std::fflush(stdout);  // in step with standard error, and kept if the program should end at a later file
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
        "Prints a line for each sane file on standard output and for each refused file on standard\n"
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
    std::map<std::string, std::function<nlohmann::ordered_json()>> schemas;
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

}  // namespace

int run_cooker(int argc, const char* const* argv, const cook::Registry& registry,
               std::initializer_list<AddCommand> more) {
    return run_program([&] {
        int exit_code = 0;
        CLI::App program("Turns sources into the cooked assets that Rowland loads, and checks both.", "rowland-cook");
        program.set_version_flag("--version", fmt::format("rowland-cook {}", cook::tool_version()));
        program.require_subcommand(1);
        program.footer(
            "Exit codes: 0 success, 2 bad input or usage, 1 any other failure.\n\n"
            "Example: rowland-cook check content/materials/*.json");
        add_cook_command(program, registry);
        add_check_command(program, registry, exit_code);
        add_info_command(program, registry);
        add_schema_command(program, registry);
        add_attach_commands(program, registry, exit_code);
        add_farm_commands(program, registry, exit_code);
        for (const AddCommand add : more) add(program);
        try {
            program.parse(argc, argv);
        } catch (const CLI::ParseError& error) {
            return program.exit(error) == 0 ? 0 : 2;
        }
        return exit_code;
    });
}

}  // namespace rowland::editor
