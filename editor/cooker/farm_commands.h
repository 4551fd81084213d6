#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/cook/registry.h"

namespace rowland::editor {

/// rowland-cook plan: lists what is to be cooked, as jobs that many workers can share.
struct PlanCommand {
    std::vector<std::filesystem::path> sources;
    std::filesystem::path output_folder;
    bool json = false;

    CLI::App* declare(CLI::App& program);
    int run(const cook::Registry& registry) const;
};

/// rowland-cook run: does jobs of a plan, beside other workers.
struct RunCommand {
    std::filesystem::path plan;
    std::vector<std::string> ids;
    bool all = false;
    std::optional<std::filesystem::path> state_folder;
    unsigned threads = 0;

    CLI::App* declare(CLI::App& program);
    /// The exit code: 2 if a job's sources were refused, else 1 if one failed otherwise.
    int run(const cook::Registry& registry) const;
};

}  // namespace rowland::editor
