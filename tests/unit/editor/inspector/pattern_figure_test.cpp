#include "editor/inspector/physics/pattern_figure.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "modules/diffraction/asset/material.h"

namespace rowland::inspector {
namespace {

diffraction::Material foil(const glm::dvec2& a_nm, const glm::dvec2& b_nm) {
    diffraction::Material material;
    material.grating.orders.clear();
    const diffraction::SinusoidalProfile grooves{110.0};
    material.grating.lattice = diffraction::Lattice{
        .a_nm = a_nm, .b_nm = b_nm, .profile = diffraction::CrossedProfile{grooves, grooves}, .orders = 1};
    material.grating.pitch_nm = 1000.0;
    return material;
}

/// The brightest texel with u_h near 0 and u_g > 0.
double brightest_u_g(const PatternFigure& figure) {
    double best = 0.0;
    for (double u = 0.1; u < figure.half_width; u += 0.005)
        if (best == 0.0 || figure.at(u, 0.0).y > figure.at(best, 0.0).y) best = u;
    return best;
}

TEST(PatternFigure, AnOrderIsASpectrumWithVioletInside) {
    const PatternFigure figure = pattern_figure(foil({1000.0, 0.0}, {0.0, 1000.0}));
    ASSERT_GT(figure.size, 0);
    // u = λ/a: 440 nm, 550 nm and 640 nm.
    const glm::dvec3 violet = figure.at(0.44, 0.0);
    const glm::dvec3 green = figure.at(0.55, 0.0);
    const glm::dvec3 red = figure.at(0.64, 0.0);
    EXPECT_GT(violet.z, 2.0 * violet.y);
    EXPECT_GT(green.y, 1.2 * green.x);
    EXPECT_GT(red.x, 1.5 * red.y);
    EXPECT_LT(figure.at(0.25, 0.0).y, 0.01 * green.y);  // between the middle and the order
    EXPECT_LT(figure.at(0.55, 0.25).y, 0.01 * green.y);
    EXPECT_GT(figure.at(0.55, 0.55).y, 0.01 * green.y);  // order (1, 1) on the diagonal
}

TEST(PatternFigure, ItFollowsTheLattice) {
    const double at = brightest_u_g(pattern_figure(foil({1000.0, 0.0}, {0.0, 1000.0})));
    const double wider = brightest_u_g(pattern_figure(foil({2000.0, 0.0}, {0.0, 1000.0})));
    EXPECT_NEAR(wider, at / 2.0, 0.01);  // two texels
    EXPECT_NEAR(at, 0.55, 0.03);
    // b (500, 1000): a* = (1, −0.5)/1000 nm, so that order (1, 0) leaves the g axis.
    const PatternFigure skewed = pattern_figure(foil({1000.0, 0.0}, {500.0, 1000.0}));
    EXPECT_GT(skewed.at(0.55, -0.275).y, 10.0 * skewed.at(0.55, 0.0).y);
}

TEST(PatternFigure, WithoutLightItIsEmpty) {
    diffraction::Material dark = foil({1000.0, 0.0}, {0.0, 1000.0});
    dark.grating.lattice->profile = diffraction::ApertureProfile{1000.0, 1000.0};  // all light goes to order 0
    EXPECT_EQ(pattern_figure(dark).size, 0);
}

}  // namespace
}  // namespace rowland::inspector
