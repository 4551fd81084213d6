#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace rowland::colour {

enum class Metal { Al, Ag, Au, Cu };

/// "Al", "Ag", "Au", "Cu".
std::vector<std::string> metal_names();

/// One of metal_names(); nothing for another name.
std::optional<Metal> parse_metal(const std::string& name);
std::string metal_name(Metal metal);

/// n + ik at a wavelength, k ≥ 0. Linear between the table's samples and clamped outside 299–886 nm.
std::complex<double> metal_index(Metal metal, double wavelength_nm);

/// R(λ) = ((n−n₀)² + k²) / ((n+n₀)² + k²): power reflectance of a polished face in a medium of index n₀ = `medium` at
/// normal incidence, of metal_index().
double metal_reflectance(Metal metal, double wavelength_nm, double medium = 1.0);

}  // namespace rowland::colour
