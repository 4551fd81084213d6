#pragma once

#include <string>

#include "editor/trade/sweep.h"

namespace rowland::trade {

/// The columns of one setting's row: its parts, errors, times, fixed counts and bytes; null where a column does not
/// apply.
nlohmann::ordered_json sweep_row(const SweepResults& results, const ErrorRow& row);

/// A header line, then a line per error row. Cells that do not apply are empty.
std::string sweep_csv(const SweepResults& results);

/// The same rows as JSON lines, without the columns that do not apply.
std::string sweep_json_lines(const SweepResults& results);

/// The cost of an error's material and setting.
const CostRow& cost_of(const SweepResults& results, const ErrorRow& row);

}  // namespace rowland::trade
