// Times of what a page states for the processor alone: filling the maps that depend on the light, and baking the
// compact disc's view table (five bands, 64 × 32 views, all wavelengths) in closed form and as Lindsay & Agu 2006 do,
// by 15 000 stratified samples of the sphere per view. Prints JSON.
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "engine/core/parallel.h"
#include "engine/core/program.h"
#include "engine/lighting/light_samples.h"
#include "engine/lighting/procedural_probe.h"
#include "engine/math/quadrature.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/representations/circle/circle_map.h"
#include "modules/diffraction/representations/planar/lobe_map.h"
#include "modules/diffraction/representations/planar/lobe_spectrum.h"
#include "modules/diffraction/representations/planar/planar_map.h"
#include "tests/benchmark/cd_materials.h"
#include "tests/benchmark/processor.h"
#include "tests/unit/modules/diffraction/reference/brute_force.h"

namespace rowland::benchmark {
namespace {

using Coefficients = std::vector<glm::dmat3>;
using diffraction::Grating;

constexpr int kBands = 5;
constexpr std::size_t kPaperSamples = 15'000;
constexpr std::size_t kManySamples = 16 * kPaperSamples;
const diffraction::ViewGrid kGrid{.mapping = diffraction::ViewMapping::Spherical, .columns = 64, .rows = 32};

/// The views of every 41st node of the table: 48 of them, at all heights and azimuths.
std::vector<glm::dvec3> some_views() {
    std::vector<glm::dvec3> views;
    const std::size_t above_horizon = kGrid.texels() - static_cast<std::size_t>(kGrid.columns);
    for (std::size_t texel = 20; texel < above_horizon; texel += 41) {
        const int column = static_cast<int>(texel) % kGrid.columns;
        const int row = static_cast<int>(texel) / kGrid.columns;
        const glm::dvec2 v = diffraction::node_view(kGrid, column, row);
        views.emplace_back(v.x, v.y, std::sqrt(1.0 - v.x * v.x - v.y * v.y));
    }
    return views;
}

/// The limit of brute force for the flat lobe: the same integrand over s = (a, r cos t, r sin t), midpoints in a and
/// Gauss in t. It shares neither the arc coefficients nor the wavelength sums of the closed form; half the number of
/// midpoints changes it by less than 1e-5.
Coefficients fine_quadrature(const Grating& grating, const glm::dvec3& view) {
    constexpr int kSteps = 16'000;
    const colour::LightSpectra spectra;
    const math::QuadratureRule angles = math::gauss_legendre(16, 0.0, std::numbers::pi);
    std::vector<double> basis(static_cast<std::size_t>(math::sh_count(kBands)));
    Coefficients result(basis.size(), glm::dmat3(0.0));
    for (int step = 0; step < kSteps; ++step) {
        const double a = (2.0 * step + 1.0) / kSteps - 1.0;
        glm::dmat3 colour(0.0);
        for (const diffraction::Peak& peak : diffraction::visible_peaks(a + view.x, grating.pitch_nm, grating.orders))
            colour += diffraction::order_efficiency(grating, peak.order, peak.wavelength_nm) * grating.pitch_nm /
                      std::abs(peak.order) *
                      glm::outerProduct(colour::cie_xyz(peak.wavelength_nm), spectra(peak.wavelength_nm));
        if (colour == glm::dmat3(0.0)) continue;
        const double r = std::sqrt((1.0 - a) * (1.0 + a));
        for (std::size_t j = 0; j < angles.nodes.size(); ++j) {
            const glm::dvec3 s(a, r * std::cos(angles.nodes[j]), r * std::sin(angles.nodes[j]));
            math::evaluate_sh(s, kBands, basis);
            const double weight = 2.0 / kSteps * angles.weights[j] * 0.5 * s.z;
            for (std::size_t i = 0; i < basis.size(); ++i) result[i] += weight * basis[i] * colour;
        }
    }
    return result;
}

double sum_of_squares(const glm::dmat3& m) {
    return glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]);
}

double relative_rms(const std::vector<Coefficients>& found, const std::vector<Coefficients>& exact) {
    double difference = 0.0;
    double whole = 0.0;
    for (std::size_t node = 0; node < exact.size(); ++node)
        for (std::size_t i = 0; i < exact[node].size(); ++i) {
            difference += sum_of_squares(found[node][i] - exact[node][i]);
            whole += sum_of_squares(exact[node][i]);
        }
    return std::sqrt(difference / whole);
}

/// Seconds of the processor, which other programs hardly disturb.
double seconds_now() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// The table's time in seconds of one core and its relative RMS error, for each way to bake it; and how much longer
/// sampling takes for the closed form's error: its error falls as time^-rate.
nlohmann::ordered_json compare_view_tables() {
    const ThreadLimit limit(1);
    const Grating grating = diffraction::parse_material(cd_material({{"representation", "arc"}}), "the CD").grating;
    const std::vector<glm::dvec3> views = some_views();
    std::vector<Coefficients> exact;
    for (const glm::dvec3& view : views) exact.push_back(fine_quadrature(grating, view));
    const double tables = static_cast<double>(kGrid.texels()) / static_cast<double>(views.size());

    double start = seconds_now();
    const diffraction::TransferTerms terms(grating, colour::LightSpectra(), kBands);
    const double terms_s = seconds_now() - start;
    start = seconds_now();
    std::vector<Coefficients> closed;
    for (const glm::dvec3& view : views) closed.push_back(terms.coefficients(view.x, view.y));
    // A table computes one view of each mirrored pair.
    const double closed_s = terms_s + 0.5 * tables * (seconds_now() - start);
    const double closed_error = relative_rms(closed, exact);

    struct Sampled {
        double seconds;
        double error;
    };
    const auto sample = [&](std::size_t samples) {
        const colour::LightSpectra spectra;
        std::vector<Coefficients> baked;
        start = seconds_now();
        for (const glm::dvec3& view : views)
            baked.push_back(
                diffraction::brute_force_coefficients(grating, spectra, view, {.bands = kBands, .samples = samples}));
        return Sampled{tables * (seconds_now() - start), relative_rms(baked, exact)};
    };
    const Sampled paper = sample(kPaperSamples);
    const Sampled many = sample(kManySamples);
    const double rate = std::log(paper.error / many.error) / std::log(many.seconds / paper.seconds);
    return {{"closed_form", {{"seconds", closed_s}, {"error", closed_error}}},
            {"15000_samples", {{"seconds", paper.seconds}, {"error", paper.error}}},
            {"240000_samples", {{"seconds", many.seconds}, {"error", many.error}}},
            {"rate", rate},
            {"slower_at_equal_error", paper.seconds / closed_s * std::pow(paper.error / closed_error, 1.0 / rate)}};
}

/// The least of a few times, milliseconds.
template <typename F>
double least_ms(const F& run) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const auto start = std::chrono::steady_clock::now();
        run();
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        least = std::min(least, time.count());
    }
    return least;
}

/// Milliseconds on all cores to fill the coarse maps that the first frame under a new probe waits for, and full ones.
nlohmann::ordered_json time_map_fills() {
    constexpr int kLightFace = 256;  ///< of the cube that a cooked probe's light is stored in
    const lighting::ProbeImage picture(lighting::render_clear_sky({}, 1024), lighting::Mapping::Equirectangular);
    const lighting::LightSamples light = lighting::merge_samples(lighting::light_samples(picture), kLightFace);
    const diffraction::CookedMaterial cd =
        diffraction::cook_material(cd_material({{"representation", "direct"}}), "the CD");
    const double pitch_nm = cd.material.grating.pitch_nm;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, 0.9, 0.3));
    nlohmann::ordered_json times;
    for (const auto& size : {diffraction::kCoarsePlanarMap, diffraction::planar_map_size(128)})
        times[fmt::format("planar/{}x{}", size.azimuths, size.views)] =
            least_ms([&] { (void)diffraction::fill_planar_map(light, cd.kernel, pitch_nm, normal, size); });
    Grating pits = cd.material.grating;
    pits.lobe = diffraction::PitsLobe{};
    const diffraction::DiffractionPattern pattern = diffraction::diffraction_pattern(pits, colour::LightSpectra());
    for (const diffraction::LobeMapSize& size : {diffraction::kCoarseLobeMap, diffraction::LobeMapSize{}}) {
        const diffraction::LobeSpectrum spectrum(pattern, size.views);
        times[fmt::format("planar/pits/{}x{}x{}", size.azimuths, size.views.g, size.views.h)] =
            least_ms([&] { (void)diffraction::fill_lobe_map(light, spectrum, normal, size.azimuths); });
    }
    for (const diffraction::CircleMapSize& size : {diffraction::coarser({}), diffraction::CircleMapSize{}})
        times[fmt::format("circle/{}", size.side)] =
            least_ms([&] { (void)diffraction::fill_circle_map(light, cd.kernel, pitch_nm, size); });
    return times;
}

}  // namespace
}  // namespace rowland::benchmark

int main() {
    return rowland::run_program([] {
        const nlohmann::ordered_json results = {{"processor", rowland::processor_name()},
                                                {"view_table", rowland::benchmark::compare_view_tables()},
                                                {"map_fill_ms", rowland::benchmark::time_map_fills()}};
        std::puts(results.dump(2).c_str());
        return 0;
    });
}
