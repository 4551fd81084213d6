#include "editor/trade/paper_figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rowland::trade {
namespace {

diffraction::Grating slit(double grooves) {
    return {.pitch_nm = 1600.0, .grooves = grooves, .profile = diffraction::SlitProfile{.width_nm = 800.0}};
}

/// Goodman: a peak of N grooves is 0.886/N of an order wide at half its height; an order of 550 nm at 1600 nm is
/// (550/1600)/cos θ radians, θ = 20.1°.
TEST(PaperFigures, ThePeakHasItsTrueWidth) {
    const Figure2 figure = figure_2(slit(1500.0));
    const double order = 550.0 / 1600.0 / std::cos(std::asin(550.0 / 1600.0)) * 180.0 / std::numbers::pi;
    EXPECT_NEAR(figure.peak_width_degrees, 0.8859 / 1500.0 * order, 1e-3 * figure.peak_width_degrees);
    EXPECT_NEAR(figure_2(slit(150.0)).peak_width_degrees, 10.0 * figure.peak_width_degrees,
                1e-3 * figure.peak_width_degrees);
}

TEST(PaperFigures, DiffractionIsSpikesWhereInterferenceIsSmooth) {
    const Figure2 figure = figure_2(slit(1500.0));
    const auto fraction_above = [](const Curve& curve) {
        return static_cast<double>(std::count_if(curve.y.begin(), curve.y.end(), [](double y) { return y > 0.3; })) /
               static_cast<double>(curve.y.size());
    };
    EXPECT_LT(fraction_above(figure.diffraction), 0.01);
    EXPECT_GT(fraction_above(figure.interference), 0.4);
    EXPECT_EQ(*std::max_element(figure.diffraction.y.begin(), figure.diffraction.y.end()), 1.0);
    // The slit's envelope at order ±1: sinc²(½) = (2/π)².
    EXPECT_NEAR(figure.diffraction.y.front(), std::pow(2.0 / std::numbers::pi, 2.0), 1e-12);
    EXPECT_NEAR(figure.diffraction.x.back(), std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace rowland::trade
