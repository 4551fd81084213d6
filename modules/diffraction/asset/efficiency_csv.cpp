// The CSV files of measured efficiencies.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

#include "engine/colour/spectrum.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/model/brdf.h"

namespace rowland::diffraction {

namespace {

constexpr const char* kHeaderForm = "wavelength_nm[,incidence_deg],R-1,R+0,R+1,…";

/// What the header line says.
struct Header {
    std::string text;
    bool has_incidence = false;
    std::vector<int> orders;  ///< as in the file
    std::size_t first_order() const { return has_incidence ? 2 : 1; }
};

std::string_view trim(std::string_view text) {
    constexpr std::string_view spaces = " \t\r";
    const auto first = text.find_first_not_of(spaces);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(spaces) - first + 1);
}

/// The first line that is not blank.
std::string_view header_line(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty()) {
        const auto end = text.find('\n');
        const std::string_view line = trim(text.substr(0, end));
        if (!line.empty()) return line;
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return {};
}

/// `R-2`, `R+0`, `R+11`.
std::optional<int> parse_order(std::string_view name) {
    if (name.size() < 3 || name[0] != 'R' || (name[1] != '+' && name[1] != '-')) return std::nullopt;
    int magnitude = 0;
    const char* end = name.data() + name.size();
    if (name[2] == '-') return std::nullopt;
    const auto [stop, failure] = std::from_chars(name.data() + 2, end, magnitude);
    if (failure != std::errc{} || stop != end || magnitude > kHighestOrder) return std::nullopt;
    return name[1] == '-' ? -magnitude : magnitude;
}

Header parse_header(std::string_view line, const std::string& file) {
    const auto refuse = [&](std::string found) {
        refuse_input(file, "header", std::move(found), fmt::format("the header {}", kHeaderForm));
    };
    Header header{.text = std::string(line), .has_incidence = false, .orders = {}};
    std::size_t column = 0;
    for (std::string_view rest = line;; ++column) {
        const auto comma = rest.find(',');
        const std::string_view name = trim(rest.substr(0, comma));
        if (column == 0) {
            if (name != "wavelength_nm") refuse(fmt::format("\"{}\" as first column", name));
        } else if (column == 1 && name == "incidence_deg") {
            header.has_incidence = true;
        } else {
            const auto order = parse_order(name);
            if (!order) refuse(fmt::format("column \"{}\"", name));
            if (std::find(header.orders.begin(), header.orders.end(), *order) != header.orders.end())
                refuse(fmt::format("order {} twice", *order));
            header.orders.push_back(*order);
        }
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    if (header.orders.empty()) refuse("no order");
    return header;
}

[[noreturn]] void refuse_row(const NumberTable& table, std::size_t i, std::string found, std::string expected,
                             std::string remedy = "") {
    refuse_input(table.file, fmt::format("row {}", table.file_rows[i]), std::move(found), std::move(expected),
                 std::move(remedy));
}

void check_row(const NumberTable& table, std::size_t i, const Header& header) {
    const std::vector<double>& row = table.rows[i];
    if (row[0] <= 0.0) refuse_row(table, i, fmt::format("wavelength_nm {}", row[0]), "a wavelength above 0 nm");
    if (header.has_incidence && (row[1] <= -90.0 || row[1] >= 90.0))
        refuse_row(table, i, fmt::format("incidence_deg {}", row[1]), "an angle in (-90, 90)");
    double sum = 0.0;
    for (std::size_t k = 0; k < header.orders.size(); ++k) {
        const double efficiency = row[header.first_order() + k];
        if (efficiency < 0.0)
            refuse_row(table, i, fmt::format("{} for order {}", efficiency, header.orders[k]),
                       "efficiencies of 0 or more");
        sum += efficiency;
    }
    if (sum > 1.0 + kRowSumTolerance)
        refuse_row(table, i, fmt::format("efficiencies that sum to {:.6g}", sum),
                   fmt::format("a sum of at most 1 + {}", kRowSumTolerance), "are they percentages?");
}

/// Columns in ascending order of diffraction.
std::vector<std::size_t> sorted_columns(const Header& header) {
    std::vector<std::size_t> columns(header.orders.size());
    std::iota(columns.begin(), columns.end(), std::size_t{0});
    std::sort(columns.begin(), columns.end(),
              [&](std::size_t a, std::size_t b) { return header.orders[a] < header.orders[b]; });
    return columns;
}

void check_range(const EfficiencySlice& slice, const std::string& file) {
    if (slice.wavelengths_nm.front() <= colour::kVisibleMax && slice.wavelengths_nm.back() >= colour::kVisibleMin)
        return;
    refuse_input(file, "wavelength_nm",
                 fmt::format("{} to {} nm", slice.wavelengths_nm.front(), slice.wavelengths_nm.back()),
                 fmt::format("wavelengths that reach into {}-{} nm", colour::kVisibleMin, colour::kVisibleMax),
                 "are they micrometres?");
}

}  // namespace

EfficiencyTable parse_efficiency_csv(std::string_view text, const std::string& file) {
    const std::string_view line = header_line(text);
    if (line.empty()) refuse_input(file, "row 1", "an empty file", fmt::format("the header {}", kHeaderForm));
    const Header header = parse_header(line, file);
    const NumberTable table = parse_number_table(text, file, header.text);
    if (table.rows.empty()) refuse_input(file, "row 2", "no rows", "efficiencies of one wavelength or more");

    const std::vector<std::size_t> columns = sorted_columns(header);
    std::map<double, EfficiencySlice> slices;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        check_row(table, i, header);
        const std::vector<double>& row = table.rows[i];
        const double incidence_deg = header.has_incidence ? row[1] : 0.0;
        EfficiencySlice& slice = slices[incidence_deg];
        slice.incidence_deg = incidence_deg;
        if (!slice.wavelengths_nm.empty() && row[0] <= slice.wavelengths_nm.back())
            refuse_row(table, i, fmt::format("{} nm after {} nm", row[0], slice.wavelengths_nm.back()),
                       "ascending wavelengths");
        slice.wavelengths_nm.push_back(row[0]);
        for (const std::size_t k : columns) slice.efficiencies.push_back(row[header.first_order() + k]);
    }

    EfficiencyTable result;
    for (const std::size_t k : columns) result.orders.push_back(header.orders[k]);
    for (auto& [incidence_deg, slice] : slices) {
        check_range(slice, file);
        result.slices.push_back(std::move(slice));
    }
    return result;
}

std::string write_efficiency_csv(const EfficiencyTable& table) {
    std::string text = "wavelength_nm,incidence_deg";
    for (const int order : table.orders) fmt::format_to(std::back_inserter(text), ",R{:+d}", order);
    text += '\n';
    for (const EfficiencySlice& slice : table.slices) {
        for (std::size_t row = 0; row < slice.wavelengths_nm.size(); ++row) {
            fmt::format_to(std::back_inserter(text), "{},{}", slice.wavelengths_nm[row], slice.incidence_deg);
            for (std::size_t column = 0; column < table.orders.size(); ++column)
                fmt::format_to(std::back_inserter(text), ",{}", slice.efficiencies[row * table.orders.size() + column]);
            text += '\n';
        }
    }
    return text;
}

}  // namespace rowland::diffraction
