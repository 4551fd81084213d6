#include <cmath>
#include <cstdlib>
#include <ctime>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/colour/spectrum.h"
#include "engine/core/parallel.h"
#include "engine/math/quadrature.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/transfer/transfer_table.h"
#include "tests/benchmark/cd_materials.h"
#include "tests/benchmark/microbenchmarks.h"
#include "tests/unit/modules/diffraction/reference/brute_force.h"

// Baking the compact disc for each representation: what the cooker does for a material.
// The compact disc's view table (five bands, 64 × 32 views, all wavelengths) in closed form and as Lindsay & Agu 2006
// compute it, by 15 000 stratified samples of the sphere per view: the time and the error of both.

namespace rowland::microbenchmark {

void register_bakes() {
    for (const auto& representation : rowland::benchmark::timed_representations()) {
        const auto bake = [material = rowland::benchmark::material_of(representation)](::benchmark::State& state) {
            const diffraction::Material parsed = diffraction::parse_material(material, "the CD");
            for (auto _ : state) ::benchmark::DoNotOptimize(diffraction::bake_material(parsed).kernel.error);
        };
        ::benchmark::RegisterBenchmark(("bake/" + representation.name).c_str(), bake)
            ->Unit(::benchmark::kMillisecond)
            ->UseRealTime();
    }
}

namespace {

using ::benchmark::State;
using Coefficients = std::vector<glm::dmat3>;
using diffraction::Grating;

constexpr int kBands = 5;
constexpr std::size_t kPaperSamples = 15'000;
constexpr std::size_t kManySamples = 16 * kPaperSamples;
const diffraction::ViewGrid kGrid{.mapping = diffraction::ViewMapping::Spherical, .columns = 64, .rows = 32};

/// A node of the table. Errors and brute force are taken at every 41st: 48 of them, at all heights and azimuths.
struct Node {
    glm::dvec3 view;
    std::size_t texel;
};

std::vector<Node> some_nodes() {
    std::vector<Node> nodes;
    const std::size_t above_horizon = kGrid.texels() - static_cast<std::size_t>(kGrid.columns);
    for (std::size_t texel = 20; texel < above_horizon; texel += 41) {
        const int column = static_cast<int>(texel) % kGrid.columns;
        const int row = static_cast<int>(texel) / kGrid.columns;
        const glm::dvec2 v = diffraction::node_view(kGrid, column, row);
        nodes.push_back({{v.x, v.y, std::sqrt(1.0 - v.x * v.x - v.y * v.y)}, texel});
    }
    return nodes;
}

Grating cd_grating() {
    return diffraction::parse_material(rowland::benchmark::cd_material({{"representation", "transfer"}}), "the CD")
        .grating;
}

/// The limit of brute force for the flat lobe: the same integrand over s = (a, r cos t, r sin t), midpoints in a and
/// Gauss in t. It shares neither the arc coefficients nor the wavelength sums of the closed form; half the number of
/// midpoints changes it by less than 1e-5.
Coefficients fine_quadrature(const Grating& grating, const glm::dvec3& view) {
    constexpr int kSteps = 16'000;
    const colour::LightSpectra spectra;
    const math::QuadratureRule angles = math::gauss_legendre(16, 0.0, M_PI);
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

Coefficients of_table(const diffraction::TransferTable& table, std::size_t texel) {
    const auto blocks = static_cast<std::size_t>(diffraction::harmonic_layers(kBands));
    Coefficients result(static_cast<std::size_t>(math::sh_count(kBands)));
    for (std::size_t i = 0; i < result.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t o = 0; o < 3; ++o) {
                const std::size_t layer = (3 * c + o) * blocks + i / 4;
                result[i][static_cast<int>(c)][static_cast<int>(o)] =
                    table.value(layer, layer * kGrid.texels() + texel, i % 4);
            }
    return result;
}

double sum_of_squares(const glm::dmat3& m) {
    return glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]);
}

/// The time of a bake per view, in seconds of one core, and its relative RMS error over the nodes.
struct Bake {
    double seconds = 0.0;
    double error = 0.0;
};

/// Processor time, which other programs do not disturb.
double seconds_now() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

class Comparison {
 public:
    Comparison() : grating_(cd_grating()), nodes_(some_nodes()) {
        for (const Node& node : nodes_) exact_.push_back(fine_quadrature(grating_, node.view));
    }

    Bake closed_form() const {
        const double start = seconds_now();
        const diffraction::TransferTable table = diffraction::bake(
            grating_,
            diffraction::TransferSettings{.bands = kBands, .grid = kGrid, .storage = diffraction::Storage::Float});
        const double seconds = (seconds_now() - start) / static_cast<double>(kGrid.texels());
        return {seconds, error([&](std::size_t node) { return of_table(table, nodes_[node].texel); })};
    }

    Bake brute_force(std::size_t samples) const {
        const colour::LightSpectra spectra;
        std::vector<Coefficients> baked;
        const double start = seconds_now();
        for (const Node& node : nodes_)
            baked.push_back(diffraction::brute_force_coefficients(grating_, spectra, node.view,
                                                                  {.bands = kBands, .samples = samples}));
        const double seconds = (seconds_now() - start) / static_cast<double>(nodes_.size());
        return {seconds, error([&](std::size_t node) { return baked[node]; })};
    }

 private:
    template <typename CoefficientsOf>
    double error(const CoefficientsOf& of) const {
        double difference = 0.0;
        double whole = 0.0;
        for (std::size_t node = 0; node < nodes_.size(); ++node) {
            const Coefficients found = of(node);
            for (std::size_t i = 0; i < found.size(); ++i) {
                difference += sum_of_squares(found[i] - exact_[node][i]);
                whole += sum_of_squares(exact_[node][i]);
            }
        }
        return std::sqrt(difference / whole);
    }

    Grating grating_;
    std::vector<Node> nodes_;
    std::vector<Coefficients> exact_;
};

const Comparison& comparison() {
    static const Comparison one;
    return one;
}

template <typename BakeOnce>
void time_bake(State& state, const BakeOnce& bake_once) {
    const ThreadLimit limit(1);
    comparison();
    for (auto _ : state) {
        const Bake bake = bake_once();
        state.SetIterationTime(bake.seconds * static_cast<double>(kGrid.texels()));
        state.counters["each"] = bake.seconds;
        state.counters["error"] = bake.error;
    }
}

/// How much longer brute force takes for the closed form's error: its error falls as time^-rate, as measured between
/// the paper's number and 16 times as many.
void compare(State& state) {
    const ThreadLimit limit(1);
    for (auto _ : state) {
        const Bake closed = comparison().closed_form();
        const Bake brute = comparison().brute_force(kPaperSamples);
        const Bake many = comparison().brute_force(kManySamples);
        const double rate = std::log(brute.error / many.error) / std::log(many.seconds / brute.seconds);
        state.SetIterationTime(closed.seconds);
        state.counters["slower_per_view"] = brute.seconds / closed.seconds;
        state.counters["rate"] = rate;
        state.counters["slower_at_equal_error"] =
            brute.seconds / closed.seconds * std::pow(brute.error / closed.error, 1.0 / rate);
    }
}

}  // namespace

void register_brute_force() {
    const auto add = [](const std::string& name, auto function) {
        ::benchmark::RegisterBenchmark(("view_table/" + name).c_str(), function)
            ->Unit(::benchmark::kMillisecond)
            ->UseManualTime()
            ->Iterations(1);
    };
    add("closed_form", [](State& state) { time_bake(state, [] { return comparison().closed_form(); }); });
    for (const std::size_t samples : {kPaperSamples, kManySamples})
        add("brute_force/samples:" + std::to_string(samples),
            [samples](State& state) { time_bake(state, [&] { return comparison().brute_force(samples); }); });
    add("comparison", compare);
}

}  // namespace rowland::microbenchmark
