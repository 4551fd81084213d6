#include "editor/cooker/foil_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "engine/cook/cook_source.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/parallel.h"
#include "modules/asset_types.h"
#include "modules/diffraction/foil/recipe.h"

namespace rowland::editor {

namespace {

struct FoilOptions {
    std::filesystem::path recipe;
    std::filesystem::path output;
    cook::CookSettings settings;
    unsigned threads = 0;
};

void run_foil(const FoilOptions& options) {
    const std::vector<std::filesystem::path> inputs{options.recipe};
    const std::vector<Output> outputs{{.option = "--output", .path = options.output, .extension = ".glb"}};
    check_outputs(inputs, outputs);
    const auto registry = modules::asset_types();
    const std::string type = cook::as_refusal_of(options.recipe, [&] {
        const cook::AssetType* found = registry->recognise(options.recipe);
        return found ? found->name : std::string();
    });
    if (type != diffraction::foil::kFoilAssetType)
        refuse_input(options.recipe.string(), {}, type.empty() ? "no recipe" : fmt::format("a {} source", type),
                     "a foil recipe: JSON with at least an artwork", R"(begin with {"artwork": "picture.png"})");
    const ThreadLimit limit(options.threads);
    cook::cook_source(*registry, options.recipe, options.output, options.settings);
}

}  // namespace

void add_foil_command(CLI::App& program) {
    const auto options = std::make_shared<FoilOptions>();
    CLI::App* command =
        program.add_subcommand("foil", "Make a card with holographic foil, a .glb, from a recipe and pictures");
    command->add_option("RECIPE", options->recipe, "The recipe, JSON; its pictures lie beside it")->required();
    command->add_option("-o,--output", options->output, "The card, .glb; its folder is created")->required();
    command->add_option("--depfile", options->settings.depfile, "Write the files that were read, in Makefile syntax");
    command->add_option("--threads", options->threads, "Use at most N threads; 0: all cores. The result is the same")
        ->check(CLI::Range(0, 1024))
        ->type_name("N")
        ->capture_default_str();
    command->footer(
        "The shortest recipe is {\"artwork\": \"picture.png\"}. content/README.md explains the others, `rowland-cook\n"
        "schema foil` lists all keys.\n\n"
        "Example: rowland-cook foil card.json -o card.glb && rowland-demo --scene card.glb");
    command->callback([options] { run_foil(*options); });
}

}  // namespace rowland::editor
