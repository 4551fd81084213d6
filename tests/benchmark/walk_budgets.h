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
    /// The part of the gratings' pixels that each representation draws.
    std::map<std::string, double> pixels;
};

/// Stops evenly along the walk, without a limit and within budgets down to a tenth of what that takes.
std::vector<BudgetFrames> draw_under_budgets(const WalkOptions& options, int stops);

void print_budgets(const std::vector<BudgetFrames>& budgets);
nlohmann::ordered_json budgets_json(const std::vector<BudgetFrames>& budgets);

}  // namespace rowland::benchmark
