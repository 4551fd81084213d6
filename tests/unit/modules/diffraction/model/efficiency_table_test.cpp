#include "modules/diffraction/model/efficiency_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "modules/diffraction/model/grating_equation.h"
#include "modules/diffraction/model/profile.h"

namespace rowland::diffraction {
namespace {

constexpr double kPitch_nm = 1000.0;

/// d = 1000 nm, so that order ±2 is cut off at 500 nm at normal incidence and R+2 printed there is noise.
EfficiencyTable three_rows() {
    return {.orders = {-2, 0, 2},
            .slices = {{.incidence_deg = 0.0,
                        .wavelengths_nm = {400.0, 480.0, 500.0, 560.0},
                        .efficiencies = {0.20, 0.30, 0.20,  //
                                         0.16, 0.40, 0.16,  //
                                         0.00, 0.70, 3e-5,  //
                                         0.00, 0.90, 0.00}}}};
}

double at(const EfficiencyTable& table, int order, double wavelength_nm, double s_g = 0.0) {
    return table_efficiency(table, kPitch_nm, order, wavelength_nm, s_g);
}

/// Exact but for the rounding of one linear interpolation.
constexpr double kRounding = 1e-15;

TEST(EfficiencyTable, IsLinearBetweenRowsAndHeldBeyondThem) {
    const EfficiencyTable table = three_rows();
    EXPECT_NEAR(at(table, 0, 440.0), 0.35, kRounding);
    EXPECT_NEAR(at(table, 2, 420.0), 0.19, kRounding);
    EXPECT_NEAR(at(table, 0, 530.0), 0.80, kRounding);
    EXPECT_EQ(at(table, 0, 380.0), 0.30);
    EXPECT_EQ(at(table, 0, 780.0), 0.90);
}

TEST(EfficiencyTable, OrdersItDoesNotNameAreZero) {
    for (const int order : {-3, -1, 1, 3}) EXPECT_EQ(at(three_rows(), order, 440.0), 0.0);
}

TEST(EfficiencyTable, HoldsAnOrderUpToItsCutOffAndNoFurther) {
    EfficiencyTable table = three_rows();
    table.slices[0].efficiencies[7] = 0.6;  // leaves room for what holds
    for (const int order : {-2, 2}) {
        EXPECT_EQ(at(table, order, 490.0), 0.16) << order;
        EXPECT_EQ(at(table, order, 499.999), 0.16) << order;
        EXPECT_EQ(at(table, order, 500.0), 0.0) << order;
        EXPECT_EQ(at(table, order, 530.0), 0.0) << order;
    }
}

/// With a pitch that puts no cut-off between the last row and the first 0, the table's own 0 is the cut-off.
TEST(EfficiencyTable, AnOrderThatEndsWithoutACutOffEndsAtItsFirstZero) {
    EXPECT_EQ(table_efficiency(three_rows(), 3000.0, -2, 499.0, 0.0), 0.16);
    EXPECT_EQ(table_efficiency(three_rows(), 3000.0, -2, 500.0, 0.0), 0.0);
}

/// A table with power beyond an order's cut-off at normal incidence means it: pairs at a slant still show the order.
TEST(EfficiencyTable, PowerBeyondTheCutOffIsTheTablesOwn) {
    EfficiencyTable table = three_rows();
    table.slices[0].efficiencies.back() = 0.08;
    EXPECT_NEAR(at(table, 2, 530.0), 0.5 * (3e-5 + 0.08), kRounding);
}

TEST(EfficiencyTable, ATableThatEndsBeforeTheCutOffIsHeldUpToIt) {
    EfficiencyTable table = three_rows();
    table.slices[0].wavelengths_nm.resize(2);
    table.slices[0].efficiencies.resize(6);
    EXPECT_EQ(at(table, 2, 499.0), 0.16);
    EXPECT_EQ(at(table, 2, 501.0), 0.0);
}

/// Between 480 and 500 nm what holds for ±2 (0.32) and what is interpolated for 0 (up to 0.7) pass 1.
TEST(EfficiencyTable, OrdersNeverSumToMoreThanOne) {
    const EfficiencyTable table = three_rows();
    double largest = 0.0;
    for (double wavelength_nm = 380.0; wavelength_nm <= 780.0; wavelength_nm += 0.1) {
        double sum = 0.0;
        for (const int order : table.orders) sum += at(table, order, wavelength_nm);
        largest = std::max(largest, sum);
    }
    EXPECT_NEAR(largest, 1.0, kRounding);
    EXPECT_LT(at(table, 2, 499.9), 0.16);
}

/// Two incidences, one row each: linear in the angle.
EfficiencyTable two_incidences() {
    return {.orders = {-1, 1},
            .slices = {{.incidence_deg = 0.0, .wavelengths_nm = {500.0}, .efficiencies = {0.4, 0.4}},
                       {.incidence_deg = 40.0, .wavelengths_nm = {500.0}, .efficiencies = {0.0, 0.6}}}};
}

double s_g(double incidence_deg) {
    return std::sin(incidence_deg * std::numbers::pi / 180.0);
}

TEST(EfficiencyTable, IsLinearInTheAngleOfIncidenceAndHeldBeyondIt) {
    const EfficiencyTable table = two_incidences();
    EXPECT_NEAR(at(table, 1, 500.0, s_g(10.0)), 0.45, 1e-14);  // the sine and its inverse round
    EXPECT_EQ(at(table, 1, 500.0, s_g(60.0)), 0.6);
    EXPECT_EQ(at(table, 1, 500.0, -0.5), 0.4);
    EXPECT_TRUE(depends_on_incidence(table));
    EXPECT_FALSE(depends_on_incidence(three_rows()));
}

/// Order −1 of 500 nm turns evanescent at s_g = ½, 30°.
TEST(EfficiencyTable, IsNotInterpolatedAcrossTheAngleWhereAnOrderIsCutOff) {
    const EfficiencyTable table = two_incidences();
    EXPECT_EQ(at(table, -1, 500.0, s_g(29.0)), 0.4);
    EXPECT_EQ(at(table, -1, 500.0, s_g(31.0)), 0.0);
}

}  // namespace
}  // namespace rowland::diffraction
