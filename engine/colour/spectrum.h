#pragma once

#include <complex>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rowland {
class JsonReader;
}

namespace rowland::colour {

/// The wavelengths in nm over which all spectra are integrated, by the trapezoid rule at 1 nm.
inline constexpr int kVisibleMin = 380;
inline constexpr int kVisibleMax = 780;

/// ∫ f(λ) dλ over the visible range, λ in nm. `T` is what f returns.
template <typename T, typename Function>
T integrate_visible(const Function& f) {
    T sum(0.0);
    for (int wavelength_nm = kVisibleMin; wavelength_nm <= kVisibleMax; ++wavelength_nm) {
        const bool at_an_end = wavelength_nm == kVisibleMin || wavelength_nm == kVisibleMax;
        sum += (at_an_end ? 0.5 : 1.0) * f(wavelength_nm);
    }
    return sum;
}

/// The values of a spectrum outside its table.
enum class Outside {
    Zero,   ///< for emission and sensitivity
    Clamp,  ///< the nearest value: for properties of materials
};

/// A function of wavelength given by samples, linear between them.
class SampledSpectrum {
 public:
    /// `wavelengths_nm` ascends strictly and has as many elements (≥ 2) as `values`; both finite.
    SampledSpectrum(std::vector<double> wavelengths_nm, std::vector<double> values, Outside outside);

    double operator()(double wavelength_nm) const;

    const std::vector<double>& wavelengths_nm() const { return wavelengths_nm_; }
    const std::vector<double>& values() const { return values_; }

 private:
    std::vector<double> wavelengths_nm_;
    std::vector<double> values_;
    Outside outside_;
    double even_step_nm_;  ///< distance between samples if they are evenly spaced, else 0
};

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

/// A table of data/, such as "metals/Al_nk.csv", all of which are embedded in the program.
SpectrumTable builtin_table(const std::string& name, const std::string& header);

/// Column `i` of a table as a function of wavelength.
SampledSpectrum spectrum(const SpectrumTable& table, std::size_t i, Outside outside);

/// The colour matching functions (x̄, ȳ, z̄) of the CIE 1931 2° standard observer: the 1 nm table, linear between its
/// entries, 0 outside 360–830 nm.
glm::dvec3 cie_xyz(double wavelength_nm);

enum class Metal { Al, Ag, Au, Cu };

/// "Al", "Ag", "Au", "Cu".
std::vector<std::string> metal_names();

/// The metal of a name in metal_names(); nullopt for any other name.
std::optional<Metal> parse_metal(const std::string& name);
std::string metal_name(Metal metal);
/// Reads "metal", one of metal_names(). Throws Error (input) that lists them.
Metal read_metal(JsonReader& json);

/// n + ik at a wavelength, k ≥ 0. Linear between the table's samples and clamped outside 299–886 nm.
std::complex<double> metal_index(Metal metal, double wavelength_nm);

/// R(λ) = ((n−n₀)² + k²) / ((n+n₀)² + k²): power reflectance at normal incidence of a polished surface with n + ik of
/// metal_index(), in a medium of index n₀ = `medium`.
double metal_reflectance(Metal metal, double wavelength_nm, double medium = 1.0);

}  // namespace rowland::colour
