#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/trade/commands.h"
#include "editor/trade/compare_command.h"
#include "editor/trade/evaluate_command.h"
#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/core/program.h"
#include "engine/core/utf8.h"

namespace {

constexpr int kUsageError = 2;

/// As a shell would take it.
std::string command_line(std::span<char*> arguments) {
    std::string text;
    for (const std::string argument : arguments) {
        const bool quoted = argument.empty() || argument.find_first_of(" \t\n\"$&|;<>()*?") != std::string::npos;
        text += fmt::format("{}{}", text.empty() ? "" : " ", quoted ? "'" + argument + "'" : argument);
    }
    return rowland::valid_utf8(text);
}

/// CLI11 reports a misspelt command only as a missing one.
void check_command(const CLI::App& program, std::string_view word) {
    if (word.starts_with('-')) return;
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
    if (std::ranges::find(names, word) != names.end()) return;
    const auto near = rowland::nearest_word(word, names);
    rowland::refuse_input("rowland-trade", {}, fmt::format("command \"{}\"", word),
                          fmt::format("one of {}", fmt::join(names, ", ")),
                          near ? fmt::format("is \"{}\" meant?", *near) : "see rowland-trade --help");
}

}  // namespace

int main(int argc, char** argv) {
    return rowland::run_program([&]() -> int {
        CLI::App program("rowland-trade: the error and the cost of each way to shade a grating", "rowland-trade");
        program.require_subcommand(1);
        program.footer(
            "Results go to standard output, messages to standard error. Exit codes: 0 success, 2 bad input or usage,\n"
            "1 any other failure.\n"
            "Example:\n"
            "  rowland-trade evaluate --material cd.json --probe sunset.hdr --method spikes --frames frames.csv");
        rowland::trade::add_project_command(program);
        rowland::trade::EvaluateCommand evaluate;
        evaluate.declare(program)->callback([&] { evaluate.run(); });
        rowland::trade::CompareCommand compare;
        compare.declare(program)->callback([&] { compare.run(); });
        rowland::trade::add_sweep_commands(program, command_line({argv, static_cast<std::size_t>(argc)}));
        if (argc > 1) check_command(program, argv[1]);
        try {
            program.parse(argc, argv);
        } catch (const CLI::ParseError& error) {
            return program.exit(error) == 0 ? 0 : kUsageError;
        }
        return 0;
    });
}
