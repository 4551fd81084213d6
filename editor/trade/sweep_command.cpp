#include "editor/trade/sweep_command.h"

#include <CLI/CLI.hpp>

#include "editor/trade/results.h"
#include "editor/trade/sweep_tables.h"
#include "engine/core/file.h"

namespace rowland::trade {

CLI::App* SweepCommand::declare(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("sweep", "Measure what settings lose and cost, one axis at a time around each tier");
    command->footer(
        "Writes sweep.csv and sweep.jsonl into the output folder: a row for each material, probe, set of frames and\n"
        "setting. Errors are against the reference; times are of a frame on this machine's OpenGL device; the rest "
        "are\n"
        "fixed counts. What is measured is kept at once: start a sweep that was stopped again and it goes on.\n"
        "Example:\n"
        "  rowland-trade sweep --material cd.json --probe sunset.hdr --probe church.hdr:angular --output results");
    options.declare(*command);
    return command;
}

void SweepCommand::run() const {
    const SweepResults results = Sweep(options.inputs()).run();
    write_file_atomic(options.output / "sweep.jsonl", sweep_json_lines(results));
    write_file_atomic(options.output / "sweep.csv", sweep_csv(results));
    write_results("file\n" + (options.output / "sweep.csv").string() + "\n" +
                  (options.output / "sweep.jsonl").string() + "\n");
}

}  // namespace rowland::trade
