#include "tests/unit/modules/diffraction/reference/brute_force.h"

#include <fmt/format.h>

#include <array>
#include <glm/matrix.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/model/brdf.h"

namespace rowland::diffraction {

namespace {

using std::numbers::pi;

/// A number in [0, 1) that depends on its arguments alone, so that samples can be drawn in any order (SplitMix64:
/// Steele, Lea & Flood 2014).
double random_number(std::uint64_t seed, std::uint64_t index) {
    std::uint64_t z = seed * 0xd1342543de82ef95U + (index + 1) * 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    z ^= z >> 31U;
    return static_cast<double>(z >> 11U) * 0x1p-53;
}

/// An even grid of cells of equal solid angle over the upper hemisphere, about square at its middle latitudes.
struct Strata {
    explicit Strata(std::size_t samples)
        : rows(std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(static_cast<double>(samples) / 4.0)))),
          columns(std::max<std::size_t>(1, samples / rows)) {}

    /// A direction in the cell, evenly spread over it.
    glm::dvec3 direction(std::size_t row, std::size_t column, std::uint64_t seed) const {
        const std::uint64_t cell = row * columns + column;
        const double z = (static_cast<double>(row) + random_number(seed, 2 * cell)) / static_cast<double>(rows);
        const double phi =
            2.0 * pi * (static_cast<double>(column) + random_number(seed, 2 * cell + 1)) / static_cast<double>(columns);
        const double r = std::sqrt((1.0 - z) * (1.0 + z));
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

    std::size_t rows;
    std::size_t columns;
};

/// Σ_m η_m (d/|m|) D_h s_n cmf Eᵀ of one direction.
glm::dmat3 observed_term(const Grating& grating, const colour::LightSpectra& spectra, const glm::dvec3& view,
                         const glm::dvec3& s) {
    glm::dmat3 sum(0.0);
    for (const Peak& peak : visible_peaks(s.x + view.x, grating.pitch_nm, grating.orders)) {
        const double weight = order_efficiency(grating, peak.order, peak.wavelength_nm, s.x) * grating.pitch_nm /
                              std::abs(peak.order) * lobe_density(grating.lobe, s.y + view.y, peak.wavelength_nm) * s.z;
        sum += weight * glm::outerProduct(colour::cie_xyz(peak.wavelength_nm), spectra(peak.wavelength_nm));
    }
    return sum;
}

}  // namespace

std::vector<glm::dmat3> brute_force_coefficients(const Grating& grating, const colour::LightSpectra& spectra,
                                                 const glm::dvec3& view, const BruteForceSettings& settings) {
    ROWLAND_CHECK_OP(settings.bands, >=, 1);
    ROWLAND_CHECK_OP(settings.bands, <=, math::kMaximumBands);
    ROWLAND_CHECK_OP(settings.samples, >=, std::size_t{1});
    if (grating.grooves < kManyGrooves)
        refuse_input("", "grooves", fmt::format("{}", grating.grooves),
                     fmt::format("at least {} for adaptive sampling", kManyGrooves), "use the method \"reference\"");
    const auto count = static_cast<std::size_t>(math::sh_count(settings.bands));
    std::vector<glm::dmat3> coefficients(count, glm::dmat3(0.0));
    if (view.z <= 0.0) return coefficients;

    const Strata strata(settings.samples);
    std::vector<glm::dmat3> row_sums(strata.rows * count, glm::dmat3(0.0));
    parallel_for(strata.rows, [&](std::size_t row) {
        std::array<double, math::sh_count(math::kMaximumBands)> basis;
        const std::span<glm::dmat3> sums = std::span(row_sums).subspan(row * count, count);
        for (std::size_t column = 0; column < strata.columns; ++column) {
            const glm::dvec3 s = strata.direction(row, column, settings.seed);
            const glm::dmat3 term = observed_term(grating, spectra, view, s);
            if (term == glm::dmat3(0.0)) continue;
            math::evaluate_sh(s, settings.bands, basis);
            for (std::size_t i = 0; i < count; ++i) sums[i] += basis[i] * term;
        }
    });
    const double cell = 2.0 * pi / static_cast<double>(strata.rows * strata.columns);
    for (std::size_t row = 0; row < strata.rows; ++row)
        for (std::size_t i = 0; i < count; ++i) coefficients[i] += cell * row_sums[row * count + i];
    return coefficients;
}

glm::dvec3 brute_force_radiance(const std::vector<glm::dmat3>& coefficients, const lighting::ShLight& tangent_light) {
    glm::dvec3 xyz(0.0);
    const std::size_t common = std::min(coefficients.size(), tangent_light.coefficients.size());
    for (std::size_t i = 0; i < common; ++i) xyz += coefficients[i] * tangent_light.coefficients[i];
    return xyz;
}

}  // namespace rowland::diffraction
