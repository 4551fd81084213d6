#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "modules/diffraction/model/brdf.h"
#include "tests/unit/modules/diffraction/gratings.h"

namespace rowland::diffraction {
namespace {

using test::compact_disc;

/// 1 − the mean of the squared amplitudes, as textbooks print them, by the two angles (Born & Wolf, §1.5).
double by_angles(double ior, double cosine) {
    const double outside = std::acos(cosine);
    const double inside = std::asin(std::sin(outside) / ior);
    const double across = std::sin(outside - inside) / std::sin(outside + inside);
    const double along = std::tan(outside - inside) / std::tan(outside + inside);
    return 1.0 - 0.5 * (across * across + along * along);
}

TEST(Cover, TransmittanceIsFresnels) {
    for (const double ior : {1.1, 1.33, 1.58, 2.42})
        for (const double cosine : {1e-3, 0.05, 0.3, 0.7, 0.95})
            EXPECT_NEAR(transmittance(ior, cosine), by_angles(ior, cosine), 1e-12) << ior << " " << cosine;
    for (const double ior : {1.33, 1.58})
        EXPECT_NEAR(transmittance(ior, 1.0), 4.0 * ior / ((ior + 1.0) * (ior + 1.0)), 1e-15);
}

TEST(Cover, EndsOfTheRange) {
    EXPECT_EQ(transmittance(1.58, 0.0), 0.0);
    EXPECT_EQ(transmittance(1.58, -0.5), 0.0);
    EXPECT_NEAR(transmittance(1.0, 1e-6), 1.0, 1e-15);
    EXPECT_GT(transmittance(3.0, 1e-12), 0.0);
    EXPECT_EQ(transmittance(std::optional<Cover>(), 1e-3), 1.0);
}

Grating pressed() {
    return {.pitch_nm = 1600.0, .profile = LamellarProfile{.duty = 0.35, .depth_nm = 130.0}};
}

/// Published beside the formula, to the digits printed: such a disc loses its blue first order.
TEST(Cover, TurnsTheFirstOrderOfAPressedDiscRed) {
    Grating grating = pressed();
    const double nm[] = {450.0, 550.0, 650.0};
    const double in_air[] = {0.303, 0.319, 0.291};
    const double covered[] = {0.024, 0.164, 0.270};
    for (int i = 0; i < 3; ++i) {
        grating.cover.reset();
        EXPECT_NEAR(order_efficiency(grating, 1, nm[i]), in_air[i], 6e-4);
        grating.cover = Cover{};
        EXPECT_NEAR(order_efficiency(grating, 1, nm[i]), covered[i], 6e-4);
        // As between the orders of few grooves.
        EXPECT_NEAR(fractional_order_efficiency(grating, 1.0, nm[i]), order_efficiency(grating, 1, nm[i]), 1e-14);
    }
}

TEST(Cover, MetalsReflectLessUnderIt) {
    Grating grating = pressed();
    grating.metal = colour::Metal::Al;
    EXPECT_NEAR(reflectance(grating, 550.0), 0.921, 5e-3);
    grating.cover = Cover{};
    EXPECT_NEAR(reflectance(grating, 550.0), 0.882, 5e-3);
}

TEST(Cover, ATintIsPassedTwice) {
    Grating grating = pressed();
    grating.cover = Cover{};
    const double clear = order_efficiency(grating, 1, 610.0);
    const double clear_mirror = zero_order_efficiency(grating, 610.0);
    grating.cover->tint = {0.25, 0.45, 0.9};
    const glm::dvec3 basis = colour::rgb_basis(610.0);
    const double once = 0.25 * basis.r + 0.45 * basis.g + 0.9 * basis.b;
    EXPECT_NEAR(order_efficiency(grating, 1, 610.0), once * once * clear, 1e-15);
    EXPECT_NEAR(zero_order_efficiency(grating, 610.0), once * once * clear_mirror, 1e-15);
}

TEST(Cover, ATableIsTakenAsItIs) {
    Grating grating{.pitch_nm = 1600.0,
                    .profile = EfficiencyTable{.orders = {0, 1},
                                               .slices = {{.wavelengths_nm = {500.0}, .efficiencies = {0.5, 0.3}}}}};
    grating.cover = Cover{.ior = 1.58, .tint = {0.1, 0.1, 0.1}};
    EXPECT_EQ(order_efficiency(grating, 1, 500.0), 0.3);
    EXPECT_EQ(zero_order_efficiency(grating, 500.0), 0.5);
}

TEST(Efficiency, MetalScalesEveryOrder) {
    Grating grating = compact_disc();
    const double bare = order_efficiency(grating, 1, 500.0);
    const double bare_mirror = zero_order_efficiency(grating, 500.0);
    grating.metal = colour::Metal::Au;
    const double reflectance = colour::metal_reflectance(colour::Metal::Au, 500.0);
    EXPECT_DOUBLE_EQ(order_efficiency(grating, 1, 500.0), bare * reflectance);
    EXPECT_DOUBLE_EQ(zero_order_efficiency(grating, 500.0), bare_mirror * reflectance);
    EXPECT_DOUBLE_EQ(bare_mirror, 0.25);
}

TEST(Efficiency, AguWeighsByWavelengthAndAgreesAt550nm) {
    const Grating energy = compact_disc();
    Grating agu = compact_disc();
    agu.normalization = Normalization::Agu;
    EXPECT_DOUBLE_EQ(order_efficiency(agu, 1, 550.0), order_efficiency(energy, 1, 550.0));
    EXPECT_DOUBLE_EQ(order_efficiency(agu, -1, 440.0), 0.8 * order_efficiency(energy, -1, 440.0));
    // Order 0 is the same fraction of power under either normalization.
    EXPECT_DOUBLE_EQ(zero_order_efficiency(agu, 440.0), zero_order_efficiency(energy, 440.0));
}

TEST(ShadingPoint, RowsAreARightHandedBasis) {
    const ShadingPoint frame{.view = {0, 0, 1}, .normal = {0.0, 2.0, 1.0}, .grating = {1.0, 0.5, -0.2}};
    const glm::dmat3 m = world_to_tangent(frame);
    EXPECT_NEAR(glm::determinant(m), 1.0, 1e-15);
    const glm::dmat3 product = m * glm::transpose(m);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j ? 1.0 : 0.0, 1e-15);
    EXPECT_NEAR((m * glm::normalize(frame.normal)).z, 1.0, 1e-15);
    // h = n × g: the grating vector has no component along it and a positive one along g.
    EXPECT_NEAR((m * frame.grating).y, 0.0, 1e-15);
    EXPECT_GT((m * frame.grating).x, 0.0);
    EXPECT_NEAR((m * glm::cross(frame.normal, frame.grating)).x, 0.0, 1e-15);
}

TEST(ShadingPoint, KnowsWhatIsNoFrame) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(is_valid({.view = {0, 0, 1}, .normal = {0, 0, 1}, .grating = {1, 0, 0}}));
    EXPECT_FALSE(is_valid({.view = {0, 0, 0}, .normal = {0, 0, 1}, .grating = {1, 0, 0}}));
    EXPECT_FALSE(is_valid({.view = {0, 0, 1}, .normal = {0, 0, nan}, .grating = {1, 0, 0}}));
    EXPECT_FALSE(is_valid({.view = {0, 0, 1}, .normal = {0, 0, 1}, .grating = {0, 0, -3}}));
}

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
