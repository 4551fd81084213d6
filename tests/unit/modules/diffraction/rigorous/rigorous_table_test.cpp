// The solver against converged tables by two other solvers (test data), order by order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "engine/colour/spectrum.h"
#include "modules/diffraction/rigorous/solver.h"
#include "tests/support/csv.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

struct TableCase {
    std::string file;
    Relief relief;
    double s_g = 0.0;          ///< where the file has no column for it
    double tolerance = 1e-3;   ///< absolute, of the data
    double relative_27 = 0.0;  ///< RMS error over RMS of the rows of s_h = 0.27: about 1.2 times what was measured
    double relative_55 = 0.0;  ///< of s_h = 0.55
};

const std::vector<TableCase>& cases() {
    static const std::vector<TableCase> all = {
        {"efficiency_incidence/lamellar_p1270_t95_w045_al.csv", {1270, LamellarProfile{0.45, 95}}, 0, 1e-3, .009, .048},
        {"efficiency_incidence/sinusoidal_p1000_t150_al.csv", {1000, SinusoidalProfile{150}}, 0, 1e-3, .0065, .038},
        {"efficiency_incidence/blazed_p930_t235_al.csv", {930, BlazedProfile{235}}, 0, 2e-3, .0066, .045},
        {"efficiency_converged/lamellar_p1600_t120_w050_al_0deg.csv", {1600, LamellarProfile{0.5, 120}}},
        {"efficiency_converged/lamellar_p1600_t120_w050_al_30deg.csv", {1600, LamellarProfile{0.5, 120}}, 0.5},
        {"efficiency_converged/lamellar_p740_t100_w043_al_0deg.csv", {740, LamellarProfile{0.43, 100}}},
        {"efficiency_converged/sinusoidal_p1000_t150_al_0deg.csv", {1000, SinusoidalProfile{150}}}};
    return all;
}

/// Compares every `stride`-th row. Rows out of the plane are held together, as the scaling is an approximation.
void compare(const TableCase& one, std::size_t stride) {
    ROWLAND_TEST_DATA(path, "data/" + one.file);
    const test::Csv csv = test::read_csv(path);
    const bool has_directions = csv.header[1] == "s_g";
    std::map<double, double> squares;
    std::map<double, double> differences;
    for (std::size_t row = 0; row < csv.rows.size(); row += stride) {
        const double wavelength_nm = csv.number(row, "wavelength_nm");
        const double s_g = has_directions ? csv.number(row, "s_g") : one.s_g;
        const double s_h = has_directions ? csv.number(row, "s_h") : 0.0;
        const std::complex<double> metal = colour::metal_index(colour::Metal::Al, wavelength_nm);
        const ClassicalIncidence light = classical_incidence(1.0, wavelength_nm, s_g, s_h);
        const OrderEfficiencies solved = solve(one.relief, metal, light.wavelength_nm, light.s_g,
                                               first_truncation(one.relief, metal, wavelength_nm));
        for (std::size_t column = has_directions ? 3 : 1; column < csv.header.size(); ++column) {
            const int order = std::stoi(csv.header[column].substr(1));
            const double expected = csv.number(row, csv.header[column]);
            const double actual = solved.reflected(order);
            if (s_h == 0.0) {
                EXPECT_NEAR(actual, expected, one.tolerance)
                    << wavelength_nm << " nm, s_g " << s_g << ", order " << order;
            }
            squares[s_h] += expected * expected;
            differences[s_h] += (actual - expected) * (actual - expected);
        }
    }
    if (stride > 1) return;
    for (const auto& [s_h, sum] : differences) {
        const double relative = std::sqrt(sum / squares[s_h]);
        EXPECT_LE(relative, s_h == 0.0 ? 1e-3 : s_h == 0.27 ? one.relative_27 : one.relative_55) << "s_h " << s_h;
    }
}

class RigorousTable : public ::testing::TestWithParam<TableCase> {};
class RigorousSlowTable : public ::testing::TestWithParam<TableCase> {};

TEST_P(RigorousTable, EveryTenthRowIsMet) {
    compare(GetParam(), 10);
}

TEST_P(RigorousSlowTable, EveryRowIsMet) {
    compare(GetParam(), 1);
}

std::string name_of(const ::testing::TestParamInfo<TableCase>& info) {
    const std::string& file = info.param.file;
    const std::size_t slash = file.find('/');
    return file.substr(slash + 1, file.find('.') - slash - 1);
}

INSTANTIATE_TEST_SUITE_P(Data, RigorousTable, ::testing::ValuesIn(cases()), name_of);
INSTANTIATE_TEST_SUITE_P(Data, RigorousSlowTable, ::testing::ValuesIn(cases()), name_of);

}  // namespace
}  // namespace rowland::diffraction
