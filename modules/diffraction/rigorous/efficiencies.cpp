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

/// The s_g at which a wavelength's truncation is chosen. No symmetry removes an order there.
constexpr double kConvergedFor = 0.31;
/// Rows of the grid from one choice of the truncation to the next; between, the larger of the two neighbours' margins
/// holds. Coarse gratings take more rows, as their solves take long and their margins are alike.
int rows_per_choice(double pitch_nm) {
    constexpr double kCoarse_nm = 4000.0;
    return pitch_nm > kCoarse_nm ? 20 : 5;
}

/// The s_g that are solved at one wavelength. A solve also gives light from s_g + kλ/d. All these directions together,
/// with the opposite ones if `symmetric`, have equal steps, at least as fine as the grid's. Two such sets are symmetric
/// about 0: the one is taken that is farther from ±1 + kλ/d, the directions at which an order is at the horizon.
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

/// Samples of one wavelength, by order of the grid.
using Samples = std::vector<std::vector<EfficiencyGrid::Sample>>;

/// Adds what one solve gives: for light from every direction of its comb, each order; of a symmetric relief also for
/// light from the opposite directions.
void add(const OrderEfficiencies& solved, double s_g, double period, const std::vector<int>& orders,
         const Substrate& substrate, bool symmetric, Samples& samples) {
    for (const auto [k, from] : comb_of(solved, s_g, period))
        for (std::size_t o = 0; o < orders.size(); ++o) {
            const double to = orders[o] * period - from;
            if (std::abs(to) >= 1.0) continue;
            const double efficiency = leaving(solved, orders[o], substrate, Light::Unpolarised, k);
            samples[o].push_back({from, efficiency});
            if (symmetric) samples[orders.size() - 1 - o].push_back({-from, efficiency});
        }
}

/// Makes η_m(v_g) = η_−m(−v_g) to the last bit: maps of such a grating need one half alone. The grid has order −m for
/// every order m.
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

/// Reduces all efficiencies by one factor, if necessary, so that they sum to at most `most` for every direction.
void limit_to(double most, EfficiencyGrid& grid) {
    const std::size_t nodes = grid.values.size() / grid.orders.size();
    double largest = 0.0;
    for (std::size_t node = 0; node < nodes; ++node) {
        double sum = 0.0;
        const double period =
            EfficiencyGrid::wavelength_at(static_cast<int>(node / EfficiencyGrid::kViews)) / grid.pitch_nm;
        const double v_g = EfficiencyGrid::view_at(static_cast<int>(node % EfficiencyGrid::kViews));
        for (std::size_t o = 0; o < grid.orders.size(); ++o)
            // Entries of light from below the horizon repeat others.
            if (std::abs(grid.orders[o] * period - v_g) < 1.0) sum += double{grid.values[o * nodes + node]};
        largest = std::max(largest, sum);
    }
    if (largest <= most) return;
    for (float& value : grid.values) value *= static_cast<float>(most / largest);
}

/// Rounds all values to multiples of 2⁻¹⁴ of a power of two above the largest of orders other than 0, or of 2⁻²⁴. A
/// solve magnifies the last bits of the C library's functions a million times, and cooked files shall have the same
/// bytes on all systems.
void drop_last_digits(EfficiencyGrid& grid) {
    const std::size_t nodes = grid.values.size() / grid.orders.size();
    float largest = 0.0F;
    for (std::size_t i = 0; i < grid.values.size(); ++i)
        if (grid.orders[i / nodes] != 0) largest = std::max(largest, grid.values[i]);
    int exponent = 0;
    std::frexp(largest, &exponent);
    const float unit = std::ldexp(1.0F, std::max(exponent - 14, -24));
    for (float& value : grid.values) value = unit * std::round(value / unit);
}

/// As the relief may be on either side of a sheet, replaces each efficiency by the mean of those of both sides: from
/// s_g to v_g, and from v_g to s_g. Samples are in the order of v_g; their directions are closed under v_g → mλ/d −
/// v_g.
void average_sides(std::vector<EfficiencyGrid::Sample>& samples) {
    for (std::size_t i = 0; 2 * i < samples.size(); ++i) {
        double& a = samples[i].efficiency;
        double& b = samples[samples.size() - 1 - i].efficiency;
        a = b = 0.5 * (a + b);
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

SolvedEfficiencies solve_efficiencies(const Relief& relief, const Substrate& substrate, const std::string& name) {
    check_relief(relief, name);
    constexpr int kRows = EfficiencyGrid::kWavelengths;
    SolvedEfficiencies result{.grid = empty_grid(relief.pitch_nm, orders_of(relief.pitch_nm))};
    const std::vector<int>& orders = result.grid.orders;
    const bool symmetric = !std::holds_alternative<BlazedProfile>(relief.shape);
    const auto index_at = [&](int row) { return index_of(substrate, EfficiencyGrid::wavelength_at(row)); };

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
            add(solved, s_g, wavelength_nm / relief.pitch_nm, orders, substrate, symmetric,
                rows[static_cast<std::size_t>(row)]);
        }
        progress.advance();
    });
    for (int row = 0; row < kRows; ++row)
        for (std::size_t o = 0; o < orders.size(); ++o) {
            auto& samples = rows[static_cast<std::size_t>(row)][o];
            // Sorted by both members, so that the order of two samples of one direction does not depend on the threads.
            std::ranges::sort(samples, {}, [](const EfficiencyGrid::Sample& sample) {
                return std::pair(sample.v_g, sample.efficiency);
            });
            if (std::holds_alternative<double>(substrate)) average_sides(samples);
            result.grid.set(o, row, samples);
        }
    if (symmetric) make_symmetric(result.grid);
    drop_last_digits(result.grid);
    return result;
}

namespace {

/// What solve_efficiencies() gives; those of the last few reliefs are kept.
std::shared_ptr<const EfficiencyGrid> solved_grid(const Relief& relief, const Substrate& substrate,
                                                  const std::string& name) {
    constexpr std::size_t kKept = 16;
    struct Known {
        Relief relief;
        Substrate substrate;
        std::shared_ptr<const EfficiencyGrid> grid;
    };
    static std::mutex mutex;
    static std::vector<Known> known;
    {
        const std::lock_guard lock(mutex);
        for (const Known& one : known)
            if (one.relief == relief && one.substrate == substrate) return one.grid;
    }
    auto grid = std::make_shared<const EfficiencyGrid>(solve_efficiencies(relief, substrate, name).grid);
    const std::lock_guard lock(mutex);
    if (known.size() == kKept) known.erase(known.begin());
    known.push_back({relief, substrate, grid});
    return grid;
}

}  // namespace

std::shared_ptr<const EfficiencyGrid> rigorous_efficiencies(const Grating& grating, const std::string& name) {
    auto grid = solved_grid(relief_of(grating, name), substrate_of(grating), name);
    if (!grating.transmission || grating.transmission->reflectance == 0.0) return grid;
    EfficiencyGrid limited = *grid;
    limit_to(1.0 - grating.transmission->reflectance, limited);
    return std::make_shared<const EfficiencyGrid>(std::move(limited));
}

}  // namespace rowland::diffraction
