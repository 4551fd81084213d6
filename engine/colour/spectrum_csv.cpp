#include "engine/colour/spectrum_csv.h"

#include <fmt/format.h>

#include "engine/core/embedded_file.h"
#include "engine/core/error.h"
#include "engine/core/number_table.h"

namespace rowland::colour {

std::span<const EmbeddedFile> table_files();

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
        const std::string location = fmt::format("row {}", numbers.file_rows[i]);
        if (row[0] <= 0.0 || row[0] > kMaximumWavelength_nm)
            refuse_input(file, location, fmt::format("wavelength {}", row[0]),
                         fmt::format("nanometres in (0, {}]", kMaximumWavelength_nm));
        if (i > 0 && row[0] <= table.wavelengths_nm.back())
            refuse_input(file, location, fmt::format("wavelength {} after {}", row[0], table.wavelengths_nm.back()),
                         "ascending wavelengths");
        table.wavelengths_nm.push_back(row[0]);
        for (std::size_t c = 1; c < row.size(); ++c) table.columns[c - 1].push_back(row[c]);
    }
    return table;
}

SpectrumTable builtin_table(const std::string& name, const std::string& header) {
    return parse_spectrum_csv(embedded_text(table_files(), "engine/colour/data/" + name), name, header);
}

SampledSpectrum spectrum(const SpectrumTable& table, std::size_t i, Outside outside) {
    return {table.wavelengths_nm, table.columns[i], outside};
}

}  // namespace rowland::colour
