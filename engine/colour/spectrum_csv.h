#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/colour/sampled_spectrum.h"

namespace rowland::colour {

/// A table of spectra: the first column is the wavelength in nm, ascending strictly.
struct SpectrumTable {
    std::vector<double> wavelengths_nm;
    std::vector<std::vector<double>> columns;  ///< the other columns, each as long as wavelengths_nm
};

/// Parses CSV text whose header line is exactly `header` (names joined by commas). Lines may end in CR LF; a byte order
/// mark, blank lines and spaces around fields are ignored. Throws Error (input) naming `file` and the row for another
/// header, a wrong number of fields, a field that is no finite number, wavelengths that do not ascend or lie outside
/// (0, 1e6], and fewer than two rows. The header is row 1.
SpectrumTable parse_spectrum_csv(std::string_view text, const std::string& file, const std::string& header);

/// A table of data/, which is built in: "metals/Al_nk.csv".
SpectrumTable builtin_table(const std::string& name, const std::string& header);

/// Column `i` of a table as a function of wavelength.
SampledSpectrum spectrum(const SpectrumTable& table, std::size_t i, Outside outside);

}  // namespace rowland::colour
