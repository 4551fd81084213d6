#pragma once

#include <optional>
#include <string>

namespace rowland::colour {

enum class Metal { Al, Ag, Au, Cu };

/// "Al", "Ag", "Au" or "Cu"; nothing for another name.
std::optional<Metal> parse_metal(const std::string& name);
std::string metal_name(Metal metal);

/// R(λ) = ((n−n₀)² + k²) / ((n+n₀)² + k²): power reflectance of a polished face in a medium of index n₀ = `medium` at
/// normal incidence. n and k are linear between the table's samples and clamped outside 299–886 nm.
double metal_reflectance(Metal metal, double wavelength_nm, double medium = 1.0);

}  // namespace rowland::colour
