#pragma once

#include "editor/trade/sweep_options.h"

namespace rowland::trade {

/// `rowland-trade sweep`: errors, times, counts and bytes of many settings, as CSV and JSON lines in a folder.
struct SweepCommand {
    SweepOptions options;

    /// Adds the subcommand, whose options fill this object.
    CLI::App* declare(CLI::App& program);
    void run() const;
};

}  // namespace rowland::trade
