#include "engine/colour/spectrum_csv.h"

#include <fmt/format.h>

#include "engine/core/error.h"
#include "engine/core/number_table.h"

namespace rowland::colour {

namespace {

constexpr double kMaximumWavelength_nm = 1e6;

}  // namespace

SpectrumTable parse_spectrum_csv(std::string_view text, const std::string& file, const std::string& header) {
    const NumberTable numbers = parse_number_table(text, file, header);
    if (numbers.rows.size() < 2)
        refuse_input(file, "", fmt::format("{} rows of data", numbers.rows.size()),
                     "the header " + header + " and at least two rows");
    SpectrumTable table;
    table.columns.resize(numbers.rows[0].size() - 1);
    for (std::size_t i = 0; i < numbers.rows.size(); ++i) {
        const std::vector<double>& row = numbers.rows[i];
        const std::string place = fmt::format("row {}", numbers.file_rows[i]);
        if (row[0] <= 0.0 || row[0] > kMaximumWavelength_nm)
            refuse_input(file, place, fmt::format("wavelength {}", row[0]),
                         fmt::format("nanometres in (0, {}]", kMaximumWavelength_nm));
        if (i > 0 && row[0] <= table.wavelengths_nm.back())
            refuse_input(file, place, fmt::format("wavelength {} after {}", row[0], table.wavelengths_nm.back()),
                         "ascending wavelengths");
        table.wavelengths_nm.push_back(row[0]);
        for (std::size_t c = 1; c < row.size(); ++c) table.columns[c - 1].push_back(row[c]);
    }
    return table;
}

}  // namespace rowland::colour
