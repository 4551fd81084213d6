#pragma once

#include <string>
#include <string_view>

#include "modules/diffraction/model/efficiency_table.h"

namespace rowland::diffraction {

/// Parses a table of efficiencies: CSV with the header `wavelength_nm,R-2,R-1,R+0,R+1,…`, one column per order in any
/// order, and, for several angles of incidence, a second column `incidence_deg` in (−90, 90). Wavelengths ascend
/// (within each incidence) and reach into 380–780 nm; efficiencies are ≥ 0 and a row sums to at most
/// 1 + kRowSumTolerance. Throws Error (input) naming `file` and the row.
EfficiencyTable parse_efficiency_csv(std::string_view text, const std::string& file);

/// The text that parse_efficiency_csv() reads back to the same numbers.
std::string write_efficiency_csv(const EfficiencyTable& table);

}  // namespace rowland::diffraction
