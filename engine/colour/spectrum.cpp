#include "engine/colour/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "engine/core/text.h"

namespace rowland::colour {

namespace {

/// The distance between evenly spaced samples, which need no search, else 0.
double even_step(const std::vector<double>& x) {
    const double step = x[1] - x[0];
    for (std::size_t i = 1; i < x.size(); ++i)
        if (x[i] != x[0] + step * static_cast<double>(i)) return 0.0;
    return step;
}

}  // namespace

SampledSpectrum::SampledSpectrum(std::vector<double> wavelengths_nm, std::vector<double> values, Outside outside)
    : wavelengths_nm_(std::move(wavelengths_nm)), values_(std::move(values)), outside_(outside) {
    ROWLAND_CHECK_OP(wavelengths_nm_.size(), >=, std::size_t{2});
    ROWLAND_CHECK_OP(wavelengths_nm_.size(), ==, values_.size());
    for (std::size_t i = 1; i < wavelengths_nm_.size(); ++i)
        ROWLAND_CHECK_OP(wavelengths_nm_[i - 1], <, wavelengths_nm_[i]);
    even_step_nm_ = even_step(wavelengths_nm_);
}

double SampledSpectrum::operator()(double wavelength_nm) const {
    const auto& x = wavelengths_nm_;
    if (wavelength_nm < x.front()) return outside_ == Outside::Zero ? 0.0 : values_.front();
    if (wavelength_nm >= x.back()) {
        if (wavelength_nm == x.back() || outside_ == Outside::Clamp) return values_.back();
        return 0.0;
    }
    std::size_t i = 0;
    if (even_step_nm_ > 0.0) {
        i = std::min(static_cast<std::size_t>((wavelength_nm - x.front()) / even_step_nm_), x.size() - 2);
    } else {
        i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), wavelength_nm) - x.begin()) - 1;
    }
    const double t = (wavelength_nm - x[i]) / (x[i + 1] - x[i]);
    return values_[i] + t * (values_[i + 1] - values_[i]);
}

/// The files of data/; defined by rowland_embed_files() in CMakeLists.txt.
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

namespace {

std::array<SampledSpectrum, 3> load_observer() {
    const SpectrumTable table = builtin_table("cie1931_2deg_xyz_1nm.csv", "wavelength_nm,xbar,ybar,zbar");
    return {spectrum(table, 0, Outside::Zero), spectrum(table, 1, Outside::Zero), spectrum(table, 2, Outside::Zero)};
}

}  // namespace

glm::dvec3 cie_xyz(double wavelength_nm) {
    static const std::array<SampledSpectrum, 3> observer = load_observer();
    return {observer[0](wavelength_nm), observer[1](wavelength_nm), observer[2](wavelength_nm)};
}

namespace {

constexpr std::array<std::string_view, 4> kNames = {"Al", "Ag", "Au", "Cu"};

struct RefractiveIndex {
    SampledSpectrum n;
    SampledSpectrum k;
};

RefractiveIndex load_index(Metal metal) {
    const SpectrumTable table = builtin_table("metals/" + metal_name(metal) + "_nk.csv", "wavelength_nm,n,k");
    return {spectrum(table, 0, Outside::Clamp), spectrum(table, 1, Outside::Clamp)};
}

}  // namespace

std::vector<std::string> metal_names() {
    return {kNames.begin(), kNames.end()};
}

std::optional<Metal> parse_metal(const std::string& name) {
    for (std::size_t i = 0; i < kNames.size(); ++i)
        if (name == kNames[i]) return static_cast<Metal>(i);
    return std::nullopt;
}

std::string metal_name(Metal metal) {
    return std::string(kNames[static_cast<std::size_t>(metal)]);
}

Metal read_metal(JsonReader& json) {
    const std::vector<std::string> names = metal_names();
    return parse_metal(json.choice("metal", {names.begin(), names.end()})).value();
}

std::complex<double> metal_index(Metal metal, double wavelength_nm) {
    static const std::array<RefractiveIndex, 4> indices = {load_index(Metal::Al), load_index(Metal::Ag),
                                                           load_index(Metal::Au), load_index(Metal::Cu)};
    const RefractiveIndex& index = indices[static_cast<std::size_t>(metal)];
    return {index.n(wavelength_nm), index.k(wavelength_nm)};
}

double metal_reflectance(Metal metal, double wavelength_nm, double medium) {
    const std::complex<double> index = metal_index(metal, wavelength_nm);
    const double n = index.real();
    const double k = index.imag();
    return ((n - medium) * (n - medium) + k * k) / ((n + medium) * (n + medium) + k * k);
}

}  // namespace rowland::colour
