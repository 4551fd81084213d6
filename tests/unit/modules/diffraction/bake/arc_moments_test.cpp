#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <utility>

#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/bake/arc_moments.h"
#include "tests/support/csv.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

lighting::ShLight some_light(int bands) {
    lighting::ShLight light{bands, {}};
    for (int i = 0; i < bands * bands; ++i)
        light.coefficients.emplace_back(std::sin(1.0 + i), std::cos(2.0 * i), 1.0 / (1.0 + i));
    return light;
}

/// PHYSICS §5: A(a) = r Q₁ + r² Q₂ exactly; 1e-12 demanded, 1e-15 found.
TEST(ArcMoments, AreExactForEveryNumberOfBands) {
    for (const int bands : {1, 2, 3, 5, 8, 10, 16, 32}) {
        const ArcMoments moments(bands);
        EXPECT_LT(moments.residual(), 1e-12) << bands;
        EXPECT_EQ(moments.matrix().size(), static_cast<std::size_t>(arc_moment_count(bands) * bands * bands));
    }
}

/// The slow reference: the arc profile by n² coefficients in the tangent frame.
TEST(ArcMoments, GiveTheArcProfileOfLightInTheTangentFrame) {
    for (const int bands : {1, 4, 7}) {
        const lighting::ShLight light = some_light(bands);
        const ArcCoefficients arcs(bands, FlatLobe{});
        const auto q = ArcMoments(bands)(light);
        std::vector<double> basis(q.size());
        for (const double a : {-0.99, -0.5, 0.0, 0.123, 0.8}) {
            std::vector<double> arc(light.coefficients.size(), 0.0);
            std::vector<double> tangent(arc.size());
            arcs.accumulate(a, 0.0, 550.0, 1.0, arc);
            arcs.to_tangent_frame(arc, tangent);
            glm::dvec3 expected(0.0);
            for (std::size_t i = 0; i < tangent.size(); ++i) expected += tangent[i] * light.coefficients[i];
            glm::dvec3 found(0.0);
            evaluate_arc_basis(a, bands, basis);
            for (std::size_t k = 0; k < q.size(); ++k) found += basis[k] * q[k];
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-12) << bands << " " << a;
        }
    }
}

TEST(ArcMoments, BasisIsSinesOfTheArcsAngle) {
    std::vector<double> basis(9);
    const double angle = 0.7;
    evaluate_arc_basis(std::cos(angle), 5, basis);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(basis[k], std::sin(static_cast<double>(k + 1) * angle), 1e-14);
    for (std::size_t k = 5; k < 9; ++k)
        EXPECT_NEAR(basis[k], std::sin(angle) * std::sin(static_cast<double>(k - 4) * angle), 1e-14);
    evaluate_arc_basis(1.5, 5, basis);
    for (const double value : basis) EXPECT_EQ(value, 0.0);
}

TEST(ArcMoments, TakeLightOfFewerOrMoreBands) {
    const ArcMoments five(5);
    lighting::ShLight padded = some_light(3);
    padded.coefficients.resize(25, glm::dvec3(0.0));
    const auto padded_moments = five(padded);
    EXPECT_EQ(five(some_light(3)), padded_moments);
    lighting::ShLight cut = some_light(6);
    cut.coefficients.resize(25);
    EXPECT_EQ(five(some_light(6)), five(cut));
}

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
                                                                         {PitSequenceLobe{}, {}},
                                                                         {FlatLobe{}, polycarbonate},
                                                                         {FlatLobe{}, Cover{.ior = 1.05}},
                                                                         {GaussianLobe{0.02}, polycarbonate},
                                                                         {PitsLobe{850.0, 0.3}, polycarbonate},
                                                                         {PitSequenceLobe{}, polycarbonate}};
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
