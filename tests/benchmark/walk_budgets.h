#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/benchmark/walk_rooms.h"

namespace rowland::benchmark {

/// Frames of a walk that gratings may take so much of.
struct BudgetFrames {
    double part = 1.0;       ///< of what they take without a limit; 0: the cheapest rungs
    double budget_ms = 0.0;  ///< mean over the stops
    double spent_ms = 0.0;   ///< likewise, of the GPU or, where the processor draws, its threads
    double error = 0.0;      ///< mean over the pixels, as a multiple of what budgets ask for by default
    /// The largest change of a display value from frame to frame of a camera that stands still, in 1/255: from the
    /// first frame within the budget on, in which rungs begin to fade.
    double largest_step = 0.0;
    double settled_step = 0.0;  ///< the same after kSettling frames
    /// The part of the gratings' pixels that each representation draws.
    std::map<std::string, double> pixels;
};

/// Stops evenly along the walk, without a limit and within budgets down to a tenth of what that takes.
std::vector<BudgetFrames> draw_under_budgets(const WalkOptions& options, int stops);

void print_budgets(const std::vector<BudgetFrames>& budgets);
nlohmann::ordered_json budgets_json(const std::vector<BudgetFrames>& budgets);

}  // namespace rowland::benchmark
