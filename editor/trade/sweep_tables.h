#pragma once

#include <string>

#include "editor/trade/sweep.h"

namespace rowland::trade {

/// A row per material, probe, set of frames and setting: the setting's parts, its errors, times, fixed counts and
/// bytes. Cells that do not apply are empty. Header line first.
std::string sweep_csv(const SweepResults& results);

/// The same rows as JSON lines; what does not apply is left out.
std::string sweep_json_lines(const SweepResults& results);

/// One of those rows.
nlohmann::ordered_json sweep_row(const SweepResults& results, const ErrorRow& row);

/// The cost of an error's material and setting.
const CostRow& cost_of(const SweepResults& results, const ErrorRow& row);

}  // namespace rowland::trade
