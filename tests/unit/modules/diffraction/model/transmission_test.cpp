#include "modules/diffraction/model/transmission.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>

#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/efficiency.h"
#include "modules/diffraction/model/grating_equation.h"

namespace rowland::diffraction {
namespace {

using std::numbers::pi;

Grating sheet(const Profile& profile, double ior) {
    return {.pitch_nm = 2000.0, .profile = profile, .transmission = Transmission{ior}};
}

/// |∫ exp(iφ(y)) exp(−2πi m y) dy|² over one pitch by sampling: the wave behind a relief whose thickness is h(y).
template <typename Height>
double sampled_efficiency(const Height& height_nm, double ior, int order, double wavelength_nm) {
    constexpr int kSamples = 5000;
    std::complex<double> sum = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        const double y = (i + 0.5) / kSamples;
        const double phase = 2.0 * pi * (ior - 1.0) * height_nm(y) / wavelength_nm;
        sum += std::polar(1.0 / kSamples, phase - 2.0 * pi * order * y);
    }
    return std::norm(sum);
}

TEST(Transmission, EfficienciesAreThoseOfTheWaveBehindTheRelief) {
    constexpr double kDepth = 900.0;
    for (const double ior : {1.3, 1.5, 2.4})
        for (const double wavelength_nm : {400.0, 550.0, 700.0})
            for (int order = -3; order <= 3; ++order) {
                const auto expect = [&](const Profile& profile, const auto& height_nm) {
                    EXPECT_NEAR(profile_efficiency(profile, 2000.0, order, 2.0 * wavelength_nm / (ior - 1.0)),
                                sampled_efficiency(height_nm, ior, order, wavelength_nm), 2e-5)
                        << profile.index() << " " << order;
                    EXPECT_EQ(order_efficiency(sheet(profile, ior), order, wavelength_nm),
                              profile_efficiency(profile, 2000.0, order, 2.0 * wavelength_nm / (ior - 1.0)));
                };
                expect(LamellarProfile{0.3, kDepth}, [](double y) { return y < 0.3 ? kDepth : 0.0; });
                expect(SinusoidalProfile{kDepth}, [](double y) { return 0.5 * kDepth * std::sin(2.0 * pi * y); });
                expect(BlazedProfile{kDepth}, [](double y) { return kDepth * y; });
            }
}

TEST(Transmission, SlitsDoNotDependOnTheIndex) {
    const SlitProfile slit{700.0};
    for (const double ior : {1.0, 1.5, 3.0})
        EXPECT_EQ(order_efficiency(sheet(slit, ior), 2, 500.0), profile_efficiency(slit, 2000.0, 2, 500.0));
}

TEST(Transmission, AReliefOfIndexOnePassesAllStraightOn) {
    for (const Profile& profile :
         {Profile(LamellarProfile{0.3, 500.0}), Profile(SinusoidalProfile{500.0}), Profile(BlazedProfile{500.0})}) {
        EXPECT_EQ(zero_order_efficiency(sheet(profile, 1.0), 500.0), 1.0);
        for (const int order : {-2, -1, 1, 2})
            EXPECT_NEAR(order_efficiency(sheet(profile, 1.0), order, 500.0), 0, 1e-30);
    }
}

/// Deep grooves send their light to high orders; nothing is lost or gained, and nothing is not a number.
TEST(Transmission, OrdersSumToOneAtAnyDepthAndIndex) {
    for (const double ior : {1.0, 1.5, 3.0})
        for (const double depth_nm : {1.0, 500.0, 20000.0})
            for (const Profile& profile : {Profile(LamellarProfile{0.4, depth_nm}),
                                           Profile(SinusoidalProfile{depth_nm}), Profile(BlazedProfile{depth_nm})}) {
                double sum = 0.0;
                for (int order = -3000; order <= 3000; ++order)
                    sum += order_efficiency(sheet(profile, ior), order, 500.0);
                EXPECT_NEAR(sum, 1.0, 1e-3) << profile.index() << " " << ior << " " << depth_nm;
            }
    EXPECT_TRUE(std::isfinite(order_efficiency(sheet(SinusoidalProfile{1e7}, 3.0), 1, 380.0)));
}

/// What a sheet reflects and what it transmits, of all orders, against the analytic sum: all light for a relief, the
/// open part b/d for slits.
TEST(Transmission, BothSidesSumToTheLightThatArrives) {
    for (const double reflectance : {0.0, 0.08, 0.5, 1.0}) {
        const auto sum = [&](const Profile& profile, int highest) {
            Grating grating = sheet(profile, 1.5);
            grating.transmission->reflectance = reflectance;
            const std::optional<Grating> other = reflected_side(grating);
            EXPECT_EQ(other.has_value(), reflectance > 0.0);
            double both = 0.0;
            for (int order = -highest; order <= highest; ++order) {
                both += order_efficiency(grating, order, 550.0);
                if (other) both += order_efficiency(*other, order, 550.0);
            }
            return both;
        };
        EXPECT_NEAR(sum(LamellarProfile{0.35, 700.0}, 3000), 1.0, 1e-3);
        EXPECT_NEAR(sum(SinusoidalProfile{700.0}, 40), 1.0, 1e-9);
        EXPECT_NEAR(sum(BlazedProfile{700.0}, 3000), 1.0, 1e-3);
        EXPECT_NEAR(sum(SlitProfile{700.0}, 3000), 700.0 / 2000.0, 1e-3 * 700.0 / 2000.0);
    }
}

/// In reflection a relief delays light twice its depth, in air.
TEST(Transmission, TheReflectedSideIsAReliefInAir) {
    Grating grating = sheet(LamellarProfile{0.4, 150.0}, 1.5);
    grating.transmission->reflectance = 0.25;
    const Grating reflecting{.pitch_nm = 2000.0, .profile = LamellarProfile{0.4, 150.0}};
    EXPECT_DOUBLE_EQ(order_efficiency(*reflected_side(grating), 1, 500.0),
                     0.25 * order_efficiency(reflecting, 1, 500.0));
}

/// Thickest toward +g, the sheet bends light that passes toward +g, and its surface reflects toward −g.
TEST(Transmission, ABlazedSheetReflectsTowardItsThinSide) {
    Grating grating = sheet(BlazedProfile{200.0}, 1.5);
    grating.transmission->reflectance = 0.25;
    EXPECT_GT(order_efficiency(grating, 1, 450.0), order_efficiency(grating, -1, 450.0));
    EXPECT_LT(order_efficiency(*reflected_side(grating), 1, 450.0),
              order_efficiency(*reflected_side(grating), -1, 450.0));
}

TEST(Transmission, LightComesFromBehind) {
    const Grating grating = sheet(SlitProfile{1000.0}, 1.5);
    const glm::dvec3 v = glm::normalize(glm::dvec3(0.1, 0.05, 1.0));
    const glm::dvec3 above = glm::normalize(glm::dvec3(0.15, -0.05, 1.0));
    EXPECT_EQ(brdf_energy(grating, above, v, 500.0), 0.0);
    Grating mirror = grating;
    mirror.transmission.reset();
    const glm::dvec3 behind(above.x, above.y, -above.z);
    EXPECT_EQ(brdf_energy(grating, behind, v, 500.0), brdf_energy(mirror, above, v, 500.0));
    EXPECT_EQ(brdf_energy(mirror, behind, v, 500.0), 0.0);
}

/// u and the components along the grooves stay, and the mirrored view is as high over the other side.
TEST(Transmission, TheOtherSideSeesTheMirroredViewAsHigh) {
    const ShadingPoint front{.view = {0.3, 0.9, 0.4}, .normal = {-0.2, 0.7, 0.5}, .grating = {1.0, 0.2, 0.1}};
    const ShadingPoint behind = lit_from_behind(front);
    const glm::dvec3 seen = world_to_tangent(front) * front.view;
    const glm::dvec3 other = world_to_tangent(behind) * behind.view;
    EXPECT_NEAR(glm::length(other - glm::dvec3(seen.x, -seen.y, seen.z)), 0.0, 1e-15);
    const glm::dvec3 light(0.4, -0.8, 0.1);
    const glm::dvec3 l = world_to_tangent(front) * light;
    EXPECT_NEAR(glm::length(world_to_tangent(behind) * light - glm::dvec3(l.x, -l.y, -l.z)), 0.0, 1e-15);
}

}  // namespace
}  // namespace rowland::diffraction
