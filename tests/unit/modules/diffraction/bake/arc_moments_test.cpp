#include "modules/diffraction/bake/arc_moments.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "modules/diffraction/bake/arc_coefficients.h"

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
        RecordProperty(fmt::format("bands_{}", bands), fmt::format("{:.2g}", moments.residual()));
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

}  // namespace
}  // namespace rowland::diffraction
