#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <string_view>
#include <vector>

#include "editor/trade/compare_command.h"
#include "editor/trade/evaluate_command.h"
#include "editor/trade/project_command.h"
#include "editor/trade/report_command.h"
#include "editor/trade/sweep_command.h"
#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/core/program.h"

namespace {

constexpr int kUsageError = 2;

struct Command {
    const CLI::App* app;
    std::function<void()> run;
};

/// CLI11 only says that a command is missing where it was misspelt.
void check_command(const CLI::App& program, std::string_view word) {
    if (word.starts_with('-')) return;
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
    if (std::find(names.begin(), names.end(), word) != names.end()) return;
    const auto near = rowland::nearest_word(word, names);
    throw rowland::Error({.file = "rowland-trade",
                          .place = {},
                          .found = fmt::format("command \"{}\"", word),
                          .expected = fmt::format("one of {}", fmt::join(names, ", ")),
                          .remedy = near ? fmt::format("is \"{}\" meant?", *near) : "see rowland-trade --help"});
}

}  // namespace

int main(int argc, char** argv) {
    return rowland::run_program([&]() -> int {
        CLI::App program("rowland-trade: what speed costs in accuracy, as numbers", "rowland-trade");
        program.require_subcommand(1);
        program.footer(
            "Results go to standard output, messages to standard error. Exit codes: 0 success, 2 bad input or usage,\n"
            "1 any other failure.\n"
            "Example:\n"
            "  rowland-trade evaluate --material cd.json --probe sunset.hdr --method spikes --frames frames.csv");
        rowland::trade::ProjectCommand project;
        rowland::trade::EvaluateCommand evaluate;
        rowland::trade::CompareCommand compare;
        rowland::trade::SweepCommand sweep;
        rowland::trade::ReportCommand report;
        const std::vector<Command> commands = {{project.declare(program), [&] { project.run(); }},
                                               {evaluate.declare(program), [&] { evaluate.run(); }},
                                               {compare.declare(program), [&] { compare.run(); }},
                                               {sweep.declare(program), [&] { sweep.run(); }},
                                               {report.declare(program), [&] { report.run(); }}};
        if (argc > 1) check_command(program, argv[1]);
        try {
            program.parse(argc, argv);
        } catch (const CLI::Success& help) {
            return program.exit(help);
        } catch (const CLI::ParseError& error) {
            program.exit(error);
            return kUsageError;
        }
        for (const Command& command : commands)
            if (command.app->parsed()) command.run();
        return 0;
    });
}
