#include "modules/diffraction/rigorous/efficiencies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/rigorous/solver.h"

namespace rowland::diffraction {

namespace {

/// Light for which a wavelength's truncation is chosen: no symmetry hides an order from it.
constexpr double kConvergedFor = 0.31;
/// The truncation is chosen at every so many rows; between, the larger of the two neighbours' margins holds.
constexpr int kRowsPerChoice = 5;

/// Directions at which one wavelength is solved: first + k·step for all whole k. `combs` solves give them all.
struct Directions {
    double first = 0.0;
    double step = 0.0;
    int combs = 1;

    /// As fine as the grid. Of the two sets that are symmetric about 0, the one that is farther from the directions
    /// at which an order is at the horizon, ±1 + kλ/d.
    Directions(double wavelength_nm, double pitch_nm) {
        const double period = wavelength_nm / pitch_nm;
        combs = std::max(1, static_cast<int>(std::ceil(period * EfficiencyGrid::kViews / 2.0)));
        step = period / combs;
        const double horizon = 1.0 / step - std::floor(1.0 / step);
        first = std::abs(horizon - 0.5) < 0.25 ? 0.0 : 0.5 * step;
    }
    /// The direction of comb j that is nearest to 0 from above, or less than 1.
    double of_comb(int j) const { return first + step * j; }
};

struct Row {
    std::vector<std::vector<EfficiencyGrid::Sample>> samples;  ///< by order of the grid
};

/// Adds what one solve gives: for light from every direction of its comb, each order.
void add(const OrderEfficiencies& solved, double s_g, double period, const std::vector<int>& orders, bool mirrored,
         Row& row) {
    const auto size = static_cast<int>(solved.v_g.size());
    for (int i = 0; i < size; ++i) {
        const int k = i + solved.first;
        const double from = s_g - k * period;  // = −v_g[i]
        if (std::abs(from) >= 1.0) continue;
        for (std::size_t o = 0; o < orders.size(); ++o) {
            const double to = orders[o] * period - from;
            if (std::abs(to) >= 1.0) continue;
            const double efficiency = solved.reflected(orders[o], Light::Unpolarised, k);
            row.samples[o].push_back({from, efficiency});
            if (mirrored) row.samples[orders.size() - 1 - o].push_back({-from, efficiency});
        }
    }
}

/// η_m(v_g) = η_−m(−v_g) to the last bit: maps of such a grating need one half alone. `orders` are symmetric.
void make_symmetric(EfficiencyGrid& grid) {
    const std::size_t rows = grid.orders.size() * EfficiencyGrid::kWavelengths;
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t order = row / EfficiencyGrid::kWavelengths;
        const std::size_t opposite =
            (grid.orders.size() - 1 - order) * EfficiencyGrid::kWavelengths + row % EfficiencyGrid::kWavelengths;
        for (std::size_t view = 0; view < EfficiencyGrid::kViews; ++view) {
            float& value = grid.values[row * EfficiencyGrid::kViews + view];
            float& other = grid.values[(opposite + 1) * EfficiencyGrid::kViews - 1 - view];
            value = other = 0.5F * (value + other);
        }
    }
}

/// How far beyond first_truncation() a wavelength converges, and its error.
struct Margin {
    int orders = 0;
    double error = 0.0;
};

Margin margin_at(const Relief& relief, std::complex<double> index, double wavelength_nm) {
    const Converged converged = solve_converged(relief, index, wavelength_nm, kConvergedFor, kGridTolerance);
    return {converged.truncation - converged.added - first_truncation(relief, index, wavelength_nm), converged.error};
}

/// Orders that propagate between some pair of directions for some visible wavelength, and 0.
std::vector<int> orders_of(double pitch_nm) {
    const int highest = static_cast<int>(std::ceil(2.0 * pitch_nm / colour::kVisibleMin)) - 1;
    std::vector<int> orders;
    for (int order = -highest; order <= highest; ++order) orders.push_back(order);
    return orders;
}

void check_pitch(const Relief& relief, const std::string& name) {
    const double finest_nm = colour::kVisibleMin / 2.0;
    if (relief.pitch_nm > finest_nm && relief.pitch_nm <= kCoarsestSolved_nm) return;
    refuse_input(name, "/grating/pitch_nm", fmt::format("{}", relief.pitch_nm),
                 fmt::format("a pitch above {}, from which on orders propagate, and up to {} for rigorous theory",
                             finest_nm, kCoarsestSolved_nm),
                 "use \"theory\": \"scalar\"");
}

}  // namespace

SolvedEfficiencies solve_efficiencies(const Relief& relief, colour::Metal metal, const std::string& name) {
    check_relief(relief, name);
    check_pitch(relief, name);
    constexpr int kRows = EfficiencyGrid::kWavelengths;
    SolvedEfficiencies result{.grid = empty_grid(relief.pitch_nm, orders_of(relief.pitch_nm))};
    const std::vector<int>& orders = result.grid.orders;
    const bool symmetric = !std::holds_alternative<BlazedProfile>(relief.shape);
    const auto index_at = [&](int row) { return colour::metal_index(metal, EfficiencyGrid::wavelength_at(row)); };

    std::vector<Margin> margins((kRows - 1) / kRowsPerChoice + 1);
    parallel_for(margins.size(), [&](std::size_t i) {
        const int row = static_cast<int>(i) * kRowsPerChoice;
        margins[i] = margin_at(relief, index_at(row), EfficiencyGrid::wavelength_at(row));
    });
    for (const Margin& margin : margins) result.error = std::max(result.error, margin.error);

    struct Solve {
        int row;
        int comb;
    };
    std::vector<Solve> solves;
    for (int row = 0; row < kRows; ++row) {
        const Directions directions(EfficiencyGrid::wavelength_at(row), relief.pitch_nm);
        // Comb j mirrored is comb combs − j, or combs − 1 − j where the first is half a step from 0.
        const int kept = !symmetric               ? directions.combs
                         : directions.first > 0.0 ? (directions.combs + 1) / 2
                                                  : directions.combs / 2 + 1;
        for (int comb = 0; comb < kept; ++comb) solves.push_back({row, comb});
    }
    result.solves = static_cast<int>(solves.size());
    std::vector<Row> rows(kRows, Row{.samples = std::vector<std::vector<EfficiencyGrid::Sample>>(orders.size())});
    std::mutex mutex;
    Progress progress(name + ": Maxwell's equations", solves.size());
    parallel_for(solves.size(), [&](std::size_t i) {
        const auto [row, comb] = solves[i];
        const double wavelength_nm = EfficiencyGrid::wavelength_at(row);
        const double period = wavelength_nm / relief.pitch_nm;
        double s_g = Directions(wavelength_nm, relief.pitch_nm).of_comb(comb);
        s_g -= period * std::round(s_g / period);
        if (std::abs(s_g) < 1.0) {
            const auto below = static_cast<std::size_t>(row / kRowsPerChoice);
            const int margin = std::max(margins[below].orders, margins[std::min(below + 1, margins.size() - 1)].orders);
            const OrderEfficiencies solved = solve(relief, index_at(row), wavelength_nm, s_g,
                                                   first_truncation(relief, index_at(row), wavelength_nm) + margin);
            const std::lock_guard lock(mutex);
            add(solved, s_g, period, orders, symmetric, rows[static_cast<std::size_t>(row)]);
        }
        progress.advance();
    });
    for (int row = 0; row < kRows; ++row)
        for (std::size_t o = 0; o < orders.size(); ++o) {
            auto& samples = rows[static_cast<std::size_t>(row)].samples[o];
            std::ranges::sort(samples, {}, &EfficiencyGrid::Sample::v_g);
            result.grid.set(o, row, samples);
        }
    if (symmetric) make_symmetric(result.grid);
    return result;
}

std::shared_ptr<const EfficiencyGrid> rigorous_efficiencies(const Grating& grating, const std::string& name) {
    constexpr std::size_t kKept = 16;
    struct Known {
        std::string key;
        std::shared_ptr<const EfficiencyGrid> grid;
    };
    static std::mutex mutex;
    static std::vector<Known> known;
    const Relief relief = relief_of(grating, name);
    const std::string key = std::visit(
        [&](const auto& shape) {
            double duty = 0.0;
            if constexpr (requires { shape.duty; }) duty = shape.duty;
            return fmt::format("{} {} {} {} {} {}", relief.shape.index(), relief.pitch_nm, shape.depth_nm, duty,
                               relief.ambient_ior, static_cast<int>(*grating.metal));
        },
        relief.shape);
    {
        const std::lock_guard lock(mutex);
        for (const Known& one : known)
            if (one.key == key) return one.grid;
    }
    auto grid = std::make_shared<const EfficiencyGrid>(solve_efficiencies(relief, *grating.metal, name).grid);
    const std::lock_guard lock(mutex);
    if (known.size() == kKept) known.erase(known.begin());
    known.push_back({key, grid});
    return grid;
}

}  // namespace rowland::diffraction
