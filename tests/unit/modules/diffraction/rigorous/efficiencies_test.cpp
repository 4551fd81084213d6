// The grid of a relief's efficiencies against single solves, and the reference with it against an independent one.
#include "modules/diffraction/rigorous/efficiencies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "modules/diffraction/rigorous/solver.h"

namespace rowland::diffraction {
namespace {

/// Bilinear interpolation's RMS error at random wavelengths and directions, over the RMS of the efficiencies.
double interpolation_error(const SolvedEfficiencies& solved, const Relief& relief, colour::Metal metal, int samples) {
    std::mt19937 random(5);
    const auto between = [&](double low, double high) {
        return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
    };
    double squares = 0.0;
    double differences = 0.0;
    for (int i = 0; i < samples; ++i) {
        const double wavelength_nm = between(400.0, 700.0);
        const double s_g = between(-0.95, 0.95);
        const std::complex<double> index = colour::metal_index(metal, wavelength_nm);
        const OrderEfficiencies exact =
            solve(relief, index, wavelength_nm, s_g, first_truncation(relief, index, wavelength_nm) + 8);
        for (const int order : solved.grid.orders) {
            const double v_g = order * wavelength_nm / relief.pitch_nm - s_g;
            if (std::abs(v_g) >= 1.0) continue;
            const double expected = exact.reflected(order);
            // By either direction.
            for (const double direction : {s_g, v_g}) {
                const double found = solved.grid.at(order, wavelength_nm, direction);
                squares += expected * expected;
                differences += (found - expected) * (found - expected);
            }
        }
    }
    return std::sqrt(differences / squares);
}

TEST(RigorousEfficiencies, TheGridIsWhatSingleSolvesGive) {
    const Relief disc{.pitch_nm = 740.0, .shape = LamellarProfile{0.43, 100.0}};
    const SolvedEfficiencies solved = solve_efficiencies(disc, colour::Metal::Al, "disc");
    RecordProperty("solves", solved.solves);
    const double error = interpolation_error(solved, disc, colour::Metal::Al, 60);
    RecordProperty("error", std::to_string(error));
    EXPECT_LT(error, 0.02);
    EXPECT_LE(solved.error, kGridTolerance);
    const EfficiencyGrid& grid = solved.grid;
    for (int view = 0; view < EfficiencyGrid::kViews; ++view)
        for (const int order : grid.orders)
            EXPECT_NEAR(grid.at(order, 500.0, EfficiencyGrid::view_at(view)),
                        grid.at(-order, 500.0, EfficiencyGrid::view_at(EfficiencyGrid::kViews - 1 - view)), 1e-8);
}

/// Also of two gratings that differ in their films alone, one after the other.
TEST(RigorousEfficiencies, AFilmOnTheGroovesIsSolvedWithThem) {
    Grating disc{.pitch_nm = 740.0, .profile = LamellarProfile{0.43, 100.0}};
    disc.metal = colour::Metal::Al;
    disc.theory = Theory::Rigorous;
    const auto plain = rigorous_efficiencies(disc, "disc");
    disc.films = {{.ior = 1.6, .thickness_nm = 120.0}};
    const auto filmed = rigorous_efficiencies(disc, "disc");
    const Relief relief = relief_of(disc, "disc");
    EXPECT_EQ(relief.films, disc.films);
    const SolvedEfficiencies known{.grid = *filmed};
    EXPECT_LT(interpolation_error(known, relief, colour::Metal::Al, 30), 0.05);  // waves that the film guides: .03
    EXPECT_GT(interpolation_error({.grid = *plain}, relief, colour::Metal::Al, 30), 0.1);
}

}  // namespace
}  // namespace rowland::diffraction
