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
/// The truncation is chosen at every so many rows; between, the larger of the two neighbours' margins holds. A coarse
/// grating's solves take long, and its margins are alike.
int rows_per_choice(double pitch_nm) {
    constexpr double kCoarse_nm = 4000.0;
    return pitch_nm > kCoarse_nm ? 20 : 5;
}

/// The s_g that are solved at one wavelength. Each gives light from s_g + kλ/d as well, all together (if `symmetric`,
/// with the opposite ones) equal steps as fine as the grid's. Of the two such sets that are symmetric about 0, the one
/// that is farther from the directions at which an order is at the horizon, ±1 + kλ/d.
std::vector<double> solved_directions(double wavelength_nm, double pitch_nm, bool symmetric) {
    const double period = wavelength_nm / pitch_nm;
    const int count = std::max(1, static_cast<int>(std::ceil(period * EfficiencyGrid::kViews / 2.0)));
    const double step = period / count;
    const double horizon = 1.0 / step - std::floor(1.0 / step);
    const bool holds_zero = std::abs(horizon - 0.5) < 0.25;
    const int of_half = holds_zero ? count / 2 + 1 : (count + 1) / 2;
    std::vector<double> directions;
    for (int i = 0; i < (symmetric ? of_half : count); ++i) {
        const double s_g = step * (holds_zero ? i : i + 0.5);
        const double nearest = s_g - period * std::round(s_g / period);
        if (std::abs(nearest) < 1.0) directions.push_back(nearest);
    }
    return directions;
}

/// Of one wavelength, by order of the grid.
using Samples = std::vector<std::vector<EfficiencyGrid::Sample>>;

/// Adds what one solve gives: for light from every direction of its comb, each order.
void add(const OrderEfficiencies& solved, double s_g, double period, const std::vector<int>& orders, bool mirrored,
         Samples& samples) {
    for (const auto [k, from] : comb_of(solved, s_g, period))
        for (std::size_t o = 0; o < orders.size(); ++o) {
            const double to = orders[o] * period - from;
            if (std::abs(to) >= 1.0) continue;
            const double efficiency = solved.reflected(orders[o], Light::Unpolarised, k);
            samples[o].push_back({from, efficiency});
            if (mirrored) samples[orders.size() - 1 - o].push_back({-from, efficiency});
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

}  // namespace

SolvedEfficiencies solve_efficiencies(const Relief& relief, colour::Metal metal, const std::string& name) {
    check_relief(relief, name);
    constexpr int kRows = EfficiencyGrid::kWavelengths;
    SolvedEfficiencies result{.grid = empty_grid(relief.pitch_nm, orders_of(relief.pitch_nm))};
    const std::vector<int>& orders = result.grid.orders;
    const bool symmetric = !std::holds_alternative<BlazedProfile>(relief.shape);
    const auto index_at = [&](int row) { return colour::metal_index(metal, EfficiencyGrid::wavelength_at(row)); };

    const int rows_per_margin = rows_per_choice(relief.pitch_nm);
    std::vector<Margin> margins(static_cast<std::size_t>((kRows - 1) / rows_per_margin + 1));
    parallel_for(margins.size(), [&](std::size_t i) {
        const int row = static_cast<int>(i) * rows_per_margin;
        margins[i] = margin_at(relief, index_at(row), EfficiencyGrid::wavelength_at(row));
    });
    for (const Margin& margin : margins) result.error = std::max(result.error, margin.error);

    struct Solve {
        int row;
        double s_g;
    };
    std::vector<Solve> solves;
    for (int row = 0; row < kRows; ++row)
        for (const double s_g : solved_directions(EfficiencyGrid::wavelength_at(row), relief.pitch_nm, symmetric))
            solves.push_back({row, s_g});
    result.solves = static_cast<int>(solves.size());
    std::vector<Samples> rows(kRows, Samples(orders.size()));
    std::mutex mutex;
    Progress progress(name + ": Maxwell's equations", solves.size());
    parallel_for(solves.size(), [&](std::size_t i) {
        const auto [row, s_g] = solves[i];
        const double wavelength_nm = EfficiencyGrid::wavelength_at(row);
        const auto below = static_cast<std::size_t>(row / rows_per_margin);
        const int margin = std::max(margins[below].orders, margins[std::min(below + 1, margins.size() - 1)].orders);
        const OrderEfficiencies solved = solve(relief, index_at(row), wavelength_nm, s_g,
                                               truncation_with(margin, relief, index_at(row), wavelength_nm));
        {
            const std::lock_guard lock(mutex);
            add(solved, s_g, wavelength_nm / relief.pitch_nm, orders, symmetric, rows[static_cast<std::size_t>(row)]);
        }
        progress.advance();
    });
    for (int row = 0; row < kRows; ++row)
        for (std::size_t o = 0; o < orders.size(); ++o) {
            auto& samples = rows[static_cast<std::size_t>(row)][o];
            // By both, so that the result does not depend on which of two at one direction was solved first.
            std::ranges::sort(samples, {}, [](const EfficiencyGrid::Sample& sample) {
                return std::pair(sample.v_g, sample.efficiency);
            });
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
    std::string key = std::visit(
        [&](const auto& shape) {
            double duty = 0.0;
            if constexpr (requires { shape.duty; }) duty = shape.duty;
            return fmt::format("{} {} {} {} {} {}", relief.shape.index(), relief.pitch_nm, shape.depth_nm, duty,
                               relief.ambient_ior, static_cast<int>(*grating.metal));
        },
        relief.shape);
    for (const DielectricFilm& film : relief.films) key += fmt::format(" {} {}", film.ior, film.thickness_nm);
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
