#include "editor/inspector/rigorous_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "modules/diffraction/rigorous/solver.h"

namespace rowland::inspector {
namespace {

using diffraction::Light;

RigorousInputs dvd() {
    return {.relief = {.pitch_nm = 740.0, .shape = diffraction::LamellarProfile{.duty = 0.43, .depth_nm = 103.0}},
            .substrate = colour::Metal::Al,
            .orders = {-1, 0, 1},
            .wavelength_nm = 500.0,
            .s_g = 0.2};
}

/// The largest difference from single solves at the curves' own points.
double largest_error(const RigorousInputs& inputs, const std::vector<RigorousOrder>& curves) {
    double largest = 0.0;
    const auto compare = [&](const RigorousOrder& curve, const PolarisedPoint& point, double wavelength_nm,
                             double s_g) {
        const auto index = diffraction::index_of(inputs.substrate, wavelength_nm);
        const auto solved = solve_converged(inputs.relief, index, wavelength_nm, s_g).efficiencies;
        largest = std::max({largest, std::abs(point.te - solved.reflected(curve.order, Light::TE)),
                            std::abs(point.tm - solved.reflected(curve.order, Light::TM))});
    };
    for (const RigorousOrder& curve : curves) {
        for (std::size_t i = 0; i < curve.over_wavelength.size(); i += 4)
            compare(curve, curve.over_wavelength[i], curve.over_wavelength[i].at, inputs.s_g);
        for (std::size_t i = 0; i < curve.over_incidence.size(); i += 7)
            compare(curve, curve.over_incidence[i], inputs.wavelength_nm,
                    std::sin(curve.over_incidence[i].at * std::numbers::pi / 180.0));
    }
    return largest;
}

TEST(RigorousCurves, AreSingleSolvesCoarseAtFirstThenConverged) {
    std::vector<RigorousOrder> coarse;
    const auto final = rigorous_curves(dvd(), {}, [&](auto curves) { coarse = std::move(curves); });
    ASSERT_TRUE(final);
    ASSERT_EQ(coarse.size(), 3U);
    ASSERT_EQ(final->size(), 3U);
    EXPECT_EQ(coarse[1].over_wavelength.size(), 9U);
    EXPECT_EQ((*final)[1].over_wavelength.size(), 41U);
    // Order 0 leaves for every incidence, order 1 where |λ/d − s_g| < 1.
    EXPECT_GE((*final)[1].over_incidence.size(), 76U);
    EXPECT_NEAR((*final)[2].over_incidence.front().at, std::asin(500.0 / 740.0 - 1.0) * 180.0 / std::numbers::pi, 2.0);
    EXPECT_LE(largest_error(dvd(), coarse), 0.02);
    EXPECT_LE(largest_error(dvd(), *final), 0.002);
}

TEST(RigorousCurves, StopWhenAsked) {
    std::stop_source stop;
    const auto stopped = rigorous_curves(dvd(), stop.get_token(), [&](const auto&) { stop.request_stop(); });
    EXPECT_FALSE(stopped);
}

TEST(RigorousCurves, OfAReliefThatDoesNotConvergeAreRefused) {
    RigorousInputs deep = dvd();
    deep.relief.pitch_nm = 20000.0;
    deep.relief.shape = diffraction::SinusoidalProfile{.depth_nm = 40000.0};
    EXPECT_ANY_THROW(rigorous_curves(deep, {}, [](const auto&) {}));
}

}  // namespace
}  // namespace rowland::inspector
