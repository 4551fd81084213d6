#include "modules/diffraction/model/lattice.h"

#include <gtest/gtest.h>

#include <complex>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {
namespace {

using std::numbers::pi;

constexpr double kGreen_nm = 550.0;

std::size_t index_of(const Lattice& lattice, int m, int k) {
    return static_cast<std::size_t>((k + lattice.orders) * order_columns(lattice) + m + lattice.orders);
}

TEST(Lattice, ReciprocalVectorsAreDualToTheCell) {
    const Lattice hexagonal{.a_nm = {1500.0, 0.0}, .b_nm = {750.0, 1299.0}};
    const glm::dmat2 stars = reciprocal(hexagonal);
    EXPECT_NEAR(glm::dot(stars[0], hexagonal.a_nm), 1.0, 1e-15);
    EXPECT_NEAR(glm::dot(stars[0], hexagonal.b_nm), 0.0, 1e-15);
    EXPECT_NEAR(glm::dot(stars[1], hexagonal.a_nm), 0.0, 1e-15);
    EXPECT_NEAR(glm::dot(stars[1], hexagonal.b_nm), 1.0, 1e-15);
}

/// PHYSICS (13.3).
TEST(Lattice, OrdersOfCrossedGroovesAreProducts) {
    const Profile a = SinusoidalProfile{.depth_nm = 120.0};
    const Profile b = BlazedProfile{.depth_nm = 250.0};
    const Lattice lattice{.a_nm = {1000.0, 0.0},
                          .b_nm = {0.0, 1200.0},
                          .profile = CrossedProfile{.along_a = a, .along_b = b},
                          .orders = 3};
    const std::vector<double> orders = lattice_efficiencies(lattice, kGreen_nm);
    ASSERT_EQ(orders.size(), 49U);
    for (int k = -3; k <= 3; ++k)
        for (int m = -3; m <= 3; ++m)
            EXPECT_DOUBLE_EQ(orders[index_of(lattice, m, k)],
                             profile_efficiency(a, 1000.0, m, kGreen_nm) * profile_efficiency(b, 1200.0, k, kGreen_nm));
}

/// A display's pixel reflects its lit area and no more, however flat the cell.
TEST(Lattice, OrdersOfAnApertureSumToItsArea) {
    for (const glm::dvec2& b : {glm::dvec2(0.0, 50000.0), glm::dvec2(40000.0, 30000.0)}) {
        const Lattice lattice{.a_nm = {50000.0, 0.0},
                              .b_nm = b,
                              .profile = ApertureProfile{.width_nm = 15000.0, .height_nm = 40000.0},
                              .orders = 400};
        const std::vector<double> orders = lattice_efficiencies(lattice, kGreen_nm);
        EXPECT_NEAR(std::accumulate(orders.begin(), orders.end(), 0.0), 0.3 * 0.8, 1e-3);
    }
}

/// A cell whose columns have one height is a lamellar groove; raised corners tell the signs of m and k.
TEST(Lattice, OrdersOfAHeightMapAreItsFourierTransform) {
    constexpr int kSide = 16;
    Lattice lattice{.a_nm = {2000.0, 0.0}, .b_nm = {0.0, 2000.0}, .profile = HeightMap{}, .orders = 3};
    HeightMap map{.columns = kSide, .rows = kSide, .heights = {}, .depth_nm = 130.0};
    for (int row = 0; row < kSide; ++row)
        for (int column = 0; column < kSide; ++column)
            map.heights.push_back(static_cast<std::uint8_t>((column * 31 + row * 17 + column * row * 5) % 256));
    lattice.profile = map;
    const std::vector<double> orders = lattice_efficiencies(lattice, kGreen_nm);
    for (int k = -3; k <= 3; ++k)
        for (int m = -3; m <= 3; ++m) {
            std::complex<double> sum = 0.0;
            for (int row = 0; row < kSide; ++row)
                for (int column = 0; column < kSide; ++column) {
                    const double along_a = (column + 0.5) / kSide;
                    const double along_b = 1.0 - (row + 0.5) / kSide;
                    const double height = map.heights[static_cast<std::size_t>(row * kSide + column)] / 255.0;
                    sum +=
                        std::polar(1.0, 4.0 * pi * 130.0 * height / kGreen_nm - 2.0 * pi * (m * along_a + k * along_b));
                }
            EXPECT_NEAR(orders[index_of(lattice, m, k)], std::norm(sum / 256.0), 1e-12) << m << " " << k;
        }
}

/// No order is brighter than what falls on the surface, whatever the heights.
TEST(Lattice, OrdersOfAHeightMapSumToAtMostOne) {
    HeightMap map{.columns = 64, .rows = 64, .heights = {}, .depth_nm = 400.0};
    for (int i = 0; i < 64 * 64; ++i) map.heights.push_back(static_cast<std::uint8_t>(i * 7919 % 251));
    const Lattice lattice{.a_nm = {2000.0, 0.0}, .b_nm = {500.0, 2000.0}, .profile = map, .orders = 31};
    const std::vector<double> orders = lattice_efficiencies(lattice, kGreen_nm);
    const double sum = std::accumulate(orders.begin(), orders.end(), 0.0);
    EXPECT_LE(sum, 1.0 + 1e-12);
    EXPECT_GT(sum, 0.9);
}

TEST(Lattice, OrderZeroAloneIsThatOfTheList) {
    HeightMap map{.columns = 16, .rows = 12, .heights = {}, .depth_nm = 300.0};
    for (int i = 0; i < 16 * 12; ++i) map.heights.push_back(static_cast<std::uint8_t>(i * 7919 % 251));
    for (const LatticeProfile& profile :
         {LatticeProfile(CrossedProfile{.along_a = SinusoidalProfile{110.0}, .along_b = BlazedProfile{150.0}}),
          LatticeProfile(ApertureProfile{.width_nm = 500.0, .height_nm = 900.0}), LatticeProfile(map)}) {
        const Lattice lattice{.a_nm = {2000.0, 0.0}, .b_nm = {500.0, 2000.0}, .profile = profile, .orders = 3};
        EXPECT_NEAR(lattice_zero_order(lattice, kGreen_nm),
                    lattice_efficiencies(lattice, kGreen_nm)[index_of(lattice, 0, 0)], 1e-15);
    }
}

/// The grooves' depth is measured in wavelengths of the medium over them.
TEST(Lattice, UnderACoverThePhaseIsTheMediums) {
    Grating grating;
    grating.orders.clear();
    grating.pitch_nm = 1000.0;
    grating.lattice = Lattice{.a_nm = {1000.0, 0.0},
                              .b_nm = {0.0, 1000.0},
                              .profile = CrossedProfile{.along_a = SinusoidalProfile{.depth_nm = 100.0},
                                                        .along_b = SinusoidalProfile{.depth_nm = 60.0}},
                              .orders = 1};
    grating.cover = Cover{.ior = 1.5};
    const std::vector<double> covered = lattice_order_efficiencies(grating, kGreen_nm);
    const std::vector<double> inside = lattice_efficiencies(*grating.lattice, kGreen_nm / 1.5);
    EXPECT_NEAR(covered[1], inside[1], 1e-12);
    EXPECT_NEAR(zero_order_efficiency(grating, kGreen_nm), inside[4], 1e-12);
}

}  // namespace
}  // namespace rowland::diffraction
