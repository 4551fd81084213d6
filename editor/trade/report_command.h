#pragma once

#include "editor/trade/report.h"
#include "editor/trade/sweep_options.h"

namespace rowland::trade {

/// `rowland-trade report`: sweeps, and draws the results and the paper's own figures into one HTML file.
struct ReportCommand {
    SweepOptions options;

    /// Adds the subcommand, whose options fill this object.
    CLI::App* declare(CLI::App& program);
    void run() const;
};

}  // namespace rowland::trade
