#include "modules/diffraction/bake/arc_coefficients.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "engine/math/sh_basis.h"
#include "tests/support/csv.h"
#include "tests/support/test_data.h"

namespace rowland::diffraction {
namespace {

std::vector<double> coefficients(const ArcCoefficients& arcs, double a, double v_h) {
    const auto count = static_cast<std::size_t>(math::sh_count(arcs.bands()));
    std::vector<double> arc_frame(count, 0.0);
    std::vector<double> tangent_frame(count, 0.0);
    arcs.accumulate(a, v_h, 550.0, 1.0, arc_frame);
    arcs.to_tangent_frame(arc_frame, tangent_frame);
    return tangent_frame;
}

/// PHYSICS §9: 1e-12.
TEST(ArcCoefficients, MatchTheOracle) {
    ROWLAND_TEST_DATA(path, "oracle/arc_coefficients_n8.csv");
    const rowland::test::Csv oracle = rowland::test::read_csv(path);
    ASSERT_EQ(oracle.rows.size(), 512U);
    const ArcCoefficients arcs(8, FlatLobe{});
    for (std::size_t row = 0; row < oracle.rows.size(); ++row) {
        const auto index = static_cast<std::size_t>(math::sh_index(oracle.integer(row, "l"), oracle.integer(row, "m")));
        EXPECT_NEAR(coefficients(arcs, oracle.number(row, "a"), 0.0)[index], oracle.number(row, "C"), 1e-12)
            << "a " << oracle.text(row, "a") << " index " << index;
    }
}

/// The slow reference: the defining integral by a midpoint rule of 1e5 nodes, 1e-9 of it. With and without covers.
TEST(ArcCoefficients, AreTheDefiningIntegralForEveryLobe) {
    const int bands = 5;
    const Cover polycarbonate;
    const std::vector<std::pair<GrooveLobe, std::optional<Cover>>> cases{{FlatLobe{}, {}},
                                                                         {GaussianLobe{0.02}, {}},
                                                                         {GaussianLobe{0.2}, {}},
                                                                         {GaussianLobe{2.0}, {}},
                                                                         {PitsLobe{850.0, 0.3}, {}},
                                                                         {PitsLobe{4000.0, 0.0}, {}},
                                                                         {FlatLobe{}, polycarbonate},
                                                                         {FlatLobe{}, Cover{.ior = 1.05}},
                                                                         {GaussianLobe{0.02}, polycarbonate},
                                                                         {PitsLobe{850.0, 0.3}, polycarbonate}};
    for (const auto& [lobe, cover] : cases) {
        const ArcCoefficients arcs(bands, lobe, cover);
        for (const double a : {-0.95, 0.0, 0.4}) {
            for (const double v_h : {-0.9, 0.0, 0.25}) {
                const double r = std::sqrt(1.0 - a * a);
                std::vector<double> expected(25, 0.0);
                std::vector<double> basis(25);
                const int nodes = 100000;
                for (int i = 0; i < nodes; ++i) {
                    const double t = std::numbers::pi * (i + 0.5) / nodes;
                    const double weight = std::numbers::pi / nodes * r * std::sin(t) *
                                          lobe_density(lobe, r * std::cos(t) + v_h, 550.0) *
                                          transmittance(cover, r * std::sin(t));
                    math::evaluate_sh({a, r * std::cos(t), r * std::sin(t)}, bands, basis);
                    for (std::size_t k = 0; k < 25; ++k) expected[k] += weight * basis[k];
                }
                const auto found = coefficients(arcs, a, v_h);
                for (std::size_t k = 0; k < 25; ++k)
                    EXPECT_NEAR(found[k], expected[k], 2e-9) << a << " " << v_h << " " << k;
            }
        }
    }
}

TEST(ArcCoefficients, VanishAtTheHorizonAndBeyond) {
    const ArcCoefficients arcs(5, GaussianLobe{0.1});
    for (const double a : {-2.0, -1.0, 1.0, 1.5})
        for (const double c : coefficients(arcs, a, 0.3)) EXPECT_EQ(c, 0.0);
}

}  // namespace
}  // namespace rowland::diffraction
