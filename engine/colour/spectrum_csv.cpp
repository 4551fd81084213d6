#include "engine/colour/spectrum_csv.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "engine/core/error.h"

namespace rowland::colour {

namespace {

constexpr double kMaximumWavelength_nm = 1e6;

std::string_view trim(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
    return text;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
    std::vector<std::string_view> fields;
    while (true) {
        const auto end = line.find(separator);
        fields.push_back(trim(line.substr(0, end)));
        if (end == std::string_view::npos) return fields;
        line.remove_prefix(end + 1);
    }
}

std::optional<double> parse_number(std::string_view text) {
    double value = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

/// What was found, short enough for a message whatever the file holds.
std::string quoted(std::string_view text) {
    return fmt::format("\"{}\"", text.substr(0, 60));
}

[[noreturn]] void fail(const std::string& file, std::size_t row, std::string found, std::string expected) {
    throw Error({.file = file,
                 .place = fmt::format("row {}", row),
                 .found = std::move(found),
                 .expected = std::move(expected),
                 .remedy = {}});
}

std::vector<double> parse_row(std::string_view line, const std::string& file, std::size_t row,
                              const std::string& header, std::size_t columns) {
    const auto fields = split(line, ',');
    if (fields.size() != columns)
        fail(file, row, fmt::format("{} fields", fields.size()), fmt::format("{} fields: {}", columns, header));
    std::vector<double> values;
    for (const std::string_view field : fields) {
        const auto value = parse_number(field);
        if (!value) fail(file, row, quoted(field), "a finite number");
        values.push_back(*value);
    }
    return values;
}

}  // namespace

SpectrumTable parse_spectrum_csv(std::string_view text, const std::string& file, const std::string& header) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    const std::size_t columns = split(header, ',').size();
    SpectrumTable table;
    table.columns.resize(columns - 1);
    bool header_seen = false;
    for (std::size_t row = 1; !text.empty(); ++row) {
        const auto end = text.find('\n');
        const std::string_view line = trim(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (line.empty()) continue;
        if (!header_seen) {
            if (split(line, ',') != split(header, ',')) fail(file, row, quoted(line), "the header " + header);
            header_seen = true;
            continue;
        }
        const auto values = parse_row(line, file, row, header, columns);
        if (values[0] <= 0.0 || values[0] > kMaximumWavelength_nm)
            fail(file, row, fmt::format("wavelength {}", values[0]),
                 fmt::format("nanometres in (0, {}]", kMaximumWavelength_nm));
        if (!table.wavelengths_nm.empty() && values[0] <= table.wavelengths_nm.back())
            fail(file, row, fmt::format("wavelength {} after {}", values[0], table.wavelengths_nm.back()),
                 "ascending wavelengths");
        table.wavelengths_nm.push_back(values[0]);
        for (std::size_t i = 1; i < columns; ++i) table.columns[i - 1].push_back(values[i]);
    }
    if (table.wavelengths_nm.size() < 2)
        throw Error({.file = file,
                     .place = {},
                     .found = fmt::format("{} rows of data", table.wavelengths_nm.size()),
                     .expected = "the header " + header + " and at least two rows",
                     .remedy = {}});
    return table;
}

}  // namespace rowland::colour
