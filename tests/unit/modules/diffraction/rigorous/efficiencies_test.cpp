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

/// The digits that are dropped are those of the brightest order but 0.
TEST(RigorousEfficiencies, OfAFaintReliefHaveAsManyDigits) {
    const Relief faint{.pitch_nm = 740.0, .shape = LamellarProfile{0.43, 1.0}};
    const SolvedEfficiencies solved = solve_efficiencies(faint, colour::Metal::Al, "faint");
    const std::complex<double> index = colour::metal_index(colour::Metal::Al, 550.0);
    for (const double s_g : {-0.2, 0.0, 0.15}) {
        const double exact = solve(faint, index, 550.0, s_g, first_truncation(faint, index, 550.0) + 8).reflected(1);
        EXPECT_LT(exact, 3e-4);
        EXPECT_NEAR(solved.grid.at(1, 550.0, s_g), exact, 0.01 * exact);
    }
}

TEST(RigorousEfficiencies, OfAFlatReliefAreAMirrors) {
    const Relief flat{.pitch_nm = 740.0, .shape = LamellarProfile{0.43, 0.0}};
    const SolvedEfficiencies solved = solve_efficiencies(flat, colour::Metal::Al, "flat");
    const std::complex<double> index = colour::metal_index(colour::Metal::Al, 550.0);
    EXPECT_NEAR(solved.grid.at(0, 550.0, 0.0), std::norm((1.0 - index) / (1.0 + index)), 1e-3);
    EXPECT_EQ(solved.grid.at(1, 550.0, 0.0), 0.0);
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

/// What a surface met from inside a sheet sends into air, times the transmittance of the sheet's flat face.
double from_inside(const Relief& inside, double wavelength_nm, double s_g, int order) {
    const double n = inside.ambient_ior;
    const OrderEfficiencies solved =
        solve(inside, 1.0, wavelength_nm, s_g, first_truncation(inside, 1.0, wavelength_nm) + 12);
    const double in_air = std::sqrt(1.0 - s_g * s_g);
    const double in_sheet = std::sqrt(1.0 - s_g * s_g / (n * n));
    const double te = (n * in_sheet - in_air) / (n * in_sheet + in_air);
    const double tm = (in_sheet - n * in_air) / (in_sheet + n * in_air);
    return 0.5 * ((1.0 - te * te) * solved.transmitted(order, Light::TE) +
                  (1.0 - tm * tm) * solved.transmitted(order, Light::TM));
}

/// Against the same surface, upside down, met from inside: by reciprocity.
TEST(RigorousEfficiencies, ASheetSendsOnWhatItsReliefDoesFromInside) {
    const struct {
        Profile sheet;
        decltype(Relief::shape) upside_down;
    } rows[] = {{LamellarProfile{0.3, 400.0}, LamellarProfile{0.7, 400.0}},
                {BlazedProfile{600.0}, BlazedProfile{600.0}}};
    for (const auto& row : rows) {
        SCOPED_TRACE(row.sheet.index());
        Grating sheet{.pitch_nm = 800.0, .profile = row.sheet, .theory = Theory::Rigorous};
        sheet.transmission = Transmission{.ior = 1.5};
        const auto grid = rigorous_efficiencies(sheet, "sheet");
        const Relief inside{.pitch_nm = sheet.pitch_nm, .shape = row.upside_down, .ambient_ior = 1.5};
        double squares = 0.0;
        double differences = 0.0;
        for (const double wavelength_nm : {450.0, 640.0})
            for (const double s_g : {-0.6, 0.1, 0.5}) {
                double sum = 0.0;
                for (const int order : grid->orders) {
                    const double v_g = order * wavelength_nm / sheet.pitch_nm - s_g;
                    if (std::abs(v_g) >= 0.98) continue;
                    // The relief on one side, and on the other.
                    const double expected = 0.5 * (from_inside(inside, wavelength_nm, s_g, order) +
                                                   from_inside(inside, wavelength_nm, v_g, order));
                    for (const double direction : {s_g, v_g}) {
                        const double found = grid->at(order, wavelength_nm, direction);
                        squares += expected * expected;
                        differences += (found - expected) * (found - expected);
                    }
                    sum += expected;
                }
                EXPECT_LT(sum, 0.96);  // the flat face alone sends on no more
            }
        EXPECT_LT(std::sqrt(differences / squares), 0.02);
    }
}

TEST(RigorousEfficiencies, ACoarseSheetNearsScalarTheoryAndKeepsWhatItReflects) {
    Grating sheet{.pitch_nm = 1200.0, .profile = BlazedProfile{120.0}, .theory = Theory::Rigorous};
    sheet.transmission = Transmission{.ior = 1.5};
    const auto grid = rigorous_efficiencies(sheet, "sheet");
    Grating scalar = sheet;
    scalar.theory = Theory::Scalar;
    const double faces = std::pow(4.0 * 1.5 / (2.5 * 2.5), 2);
    for (const int order : {-1, 0, 1, 2})
        EXPECT_NEAR(grid->at(order, 500.0, 0.0), faces * order_efficiency(scalar, order, 500.0), 0.05) << order;
    sheet.transmission->reflectance = 0.4;
    const auto reduced = rigorous_efficiencies(sheet, "sheet");
    double largest = 0.0;
    for (int view = 0; view < EfficiencyGrid::kViews; ++view) {
        const double v_g = EfficiencyGrid::view_at(view);
        double sum = 0.0;
        for (const int order : grid->orders)
            if (std::abs(order * 500.0 / sheet.pitch_nm - v_g) < 1.0) sum += reduced->at(order, 500.0, v_g);
        largest = std::max(largest, sum);
    }
    EXPECT_LT(largest, 0.6 + 1e-5);
    EXPECT_GT(largest, 0.58);
    EXPECT_EQ(reflected_side(sheet)->theory, Theory::Scalar);
}

}  // namespace
}  // namespace rowland::diffraction
