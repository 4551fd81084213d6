#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>

#include "tests/support/expect.h"
#include "tests/support/light.h"
#include "tests/support/threads.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {

namespace {

using std::numbers::pi;
using ::testing::HasSubstr;

colour::Illuminant lamp() {
    return colour::parse_illuminant("wavelength_nm,relative_power\n500,1\n580.5,3\n700,0\n", "lamp.csv");
}

LightProbe build_small_probe() {
    const ProbeImage probe = test::made_probe(Mapping::Equirectangular, 32, [](const glm::dvec3& d) {
        return glm::dvec3(std::exp(3 * d.x), 1 + d.y, d.z > 0.9 ? 500.0 : -1.0);
    });
    return build_light_probe(probe, {.bands = 6,
                                     .key_lights = 3,
                                     .light_face = 8,
                                     .prefilter = {.face_size = 16},
                                     .illuminant = lamp(),
                                     .dome = CaptureDome{1.5, 6.0}});
}

/// Built once.
const LightProbe& small_probe() {
    static const LightProbe probe = build_small_probe();
    return probe;
}

TEST(LightProbe, SurvivesSerialisation) {
    const LightProbe& probe = small_probe();
    const LightProbe read = deserialise(serialise(probe), "a.probe");
    EXPECT_EQ(serialise(read), serialise(probe));
    EXPECT_EQ(read.sh.coefficients, probe.sh.coefficients);
    EXPECT_EQ(read.illuminant.name, "lamp.csv");
    EXPECT_EQ(read.illuminant.power.values(), lamp().power.values());
    EXPECT_EQ(read.illuminant.power(400.0), 0.0);
    ASSERT_GE(probe.key_lights.size(), 1u);
    ASSERT_EQ(read.key_lights.size(), probe.key_lights.size());
    EXPECT_EQ(read.key_lights.back().concentration, probe.key_lights.back().concentration);
    EXPECT_EQ(read.light.face_size, 8);
    EXPECT_EQ(read.light.positions, probe.light.positions);
    EXPECT_EQ(read.environment.halves, probe.environment.halves);
    ASSERT_TRUE(read.dome);
    EXPECT_EQ(read.dome->radius_m, 6.0);
    EXPECT_GT(probe.report.negative, 0u);
    EXPECT_EQ(read.report.negative, probe.report.negative);
    // Computed from what is read.
    EXPECT_EQ(read.ambient.coefficients, probe.ambient.coefficients);
    EXPECT_EQ(read.ambient.window.window, probe.ambient.window.window);
    EXPECT_EQ(read.ambient.window.damping, probe.ambient.window.damping);
}

TEST(LightProbe, ADomeBelowItsCameraIsRefused) {
    LightProbe probe = small_probe();
    probe.dome.reset();
    EXPECT_FALSE(deserialise(serialise(probe), "a.probe").dome);
    for (const CaptureDome wrong : {CaptureDome{2.0, 1.0}, {-1.0, 4.0}, {1.0, 1e9}, {1.0, std::nan("")}}) {
        probe.dome = wrong;
        EXPECT_THROW(deserialise(serialise(probe), "a.probe"), Error) << wrong.height_m << ", " << wrong.radius_m;
    }
}

TEST(LightProbe, BytesDoNotDependOnTheNumberOfThreads) {
    rowland::test::expect_same_on_any_threads([] { return serialise(build_small_probe()); });
}

TEST(LightProbe, StoredShIsRawRadiance) {
    const LightProbe probe = build_light_probe(test::constant_probe(Mapping::Equirectangular, 32));
    EXPECT_EQ(probe.sh.bands, 16);
    EXPECT_NEAR(probe.sh.coefficients[0].x, std::sqrt(4 * std::numbers::pi), 1e-12);
    EXPECT_NEAR(probe.ambient.coefficients[0].x, std::sqrt(4 * std::numbers::pi), 1e-12);  // A_0/π = 1
}

TEST(LightProbe, HoldsAsManyKeyLightsAsAskedForAndAllTheLight) {
    const ProbeImage image = test::made_probe(Mapping::Equirectangular, 32, [](const glm::dvec3& d) {
        return glm::dvec3(d.y > 0.95 ? 100.0 : 1.0, 1.0, d.x < -0.95 ? 60.0 : 1.0);
    });
    LightProbeSettings settings;
    settings.bands = 3;
    settings.key_lights = 0;
    settings.light_face = 16;
    settings.prefilter.face_size = 16;
    EXPECT_TRUE(build_light_probe(image, settings).key_lights.empty());
    settings.key_lights = 2;
    const LightProbe probe = build_light_probe(image, settings);
    EXPECT_EQ(probe.key_lights.size(), 2u);
    // Halves are good to 1/2048, and the texels' bilinear parts move light between rows of unequal size.
    glm::dvec3 flux(0.0);
    const LightSamples texels = unpack(probe.light);
    for (std::size_t i = 0; i < texels.size(); ++i) flux += glm::dvec3(texels.red[i], texels.green[i], texels.blue[i]);
    const glm::dvec3 whole = probe.sh.coefficients[0] * std::sqrt(4 * std::numbers::pi);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux[c], whole[c], 0.02 * whole[c]);
}

TEST(LightProbe, EveryTruncationIsRefused) {
    const auto bytes = serialise(small_probe());
    for (std::size_t size = 0; size < bytes.size(); size += size < 64 ? 1 : 97)
        EXPECT_THROW(deserialise(std::span(bytes).first(size), "cut.probe"), Error) << size;
    auto longer = bytes;
    longer.push_back(std::byte{0});
    EXPECT_THROW(deserialise(longer, "long.probe"), Error);
}

TEST(LightProbe, WrongSizesAndValuesAreRefused) {
    const LightProbe& probe = small_probe();
    const auto bytes = serialise(probe);
    const auto refused = [&](std::size_t offset, auto value) {
        auto changed = bytes;
        std::memcpy(changed.data() + offset, &value, sizeof value);
        return test::message_of([&] { deserialise(changed, "bad.probe"); });
    };
    const std::size_t name = 4 + 8 + 36 * 24;
    const std::size_t wavelengths = name + 8 + 8;  // "lamp.csv"
    const std::size_t power = wavelengths + 8 + 24;
    const std::size_t keys = power + 8 + 24;
    const std::size_t light = keys + 8 + probe.key_lights.size() * 56;
    const std::size_t positions = light + 4 + 4 + 8 + std::size_t{18} * 8 * 8 * 2;
    const std::size_t environment = positions + 8 + std::size_t{12} * 8 * 8;
    EXPECT_THAT(refused(0, std::uint32_t{0}), HasSubstr("0 bands"));
    EXPECT_THAT(refused(0, std::uint32_t{33}), HasSubstr("33 bands"));
    EXPECT_THAT(refused(0, std::uint32_t{7}), HasSubstr("for 7 bands"));
    EXPECT_THAT(refused(4, std::uint64_t{1} << 62), HasSubstr("bytes left"));
    EXPECT_THAT(refused(12, std::nan("")), HasSubstr("not finite"));
    EXPECT_THAT(refused(name, std::uint64_t{0}), HasSubstr("name of 0 bytes"));
    EXPECT_THAT(refused(name, std::uint64_t{1} << 60), HasSubstr("bytes left"));
    EXPECT_THAT(refused(wavelengths, std::uint64_t{1} << 60), HasSubstr("bytes left"));
    for (const double bad : {0.0, -5.0, 600.0, std::nan(""), HUGE_VAL})
        EXPECT_THAT(refused(wavelengths + 8, bad), HasSubstr("ascending wavelengths")) << bad;
    for (const double bad : {-1.0, std::nan(""), HUGE_VAL})
        EXPECT_THAT(refused(power + 8, bad), HasSubstr("a power >= 0")) << bad;
    EXPECT_THAT(refused(power + 8, 1e308), HasSubstr("without visible power"));
    EXPECT_THAT(refused(keys, std::uint64_t{6}), HasSubstr("6 numbers for key lights"));
    EXPECT_THAT(refused(keys, std::uint64_t{1} << 60), HasSubstr("bytes left"));
    for (const double bad : {2.0, std::nan(""), HUGE_VAL})
        EXPECT_THAT(refused(keys + 8, bad), HasSubstr("direction of another length")) << bad;
    for (const double bad : {-1.0, std::nan(""), HUGE_VAL, 1e39})
        EXPECT_THAT(refused(keys + 8 + 24, bad), HasSubstr("flux")) << bad;
    for (const double bad : {-1.0, 0.0, std::nan(""), HUGE_VAL})
        EXPECT_THAT(refused(keys + 8 + 48, bad), HasSubstr("concentration")) << bad;
    EXPECT_THAT(refused(light, std::uint32_t{9}), HasSubstr("expected 1458"));
    EXPECT_THAT(refused(light, std::uint32_t{0xFFFFFFFF}), HasSubstr("at most 1024"));
    for (const float bad : {0.0f, -1.0f, HUGE_VALF}) EXPECT_THAT(refused(light + 4, bad), HasSubstr("scale")) << bad;
    EXPECT_THAT(refused(light + 8, std::uint64_t{1} << 62), HasSubstr("bytes left"));
    EXPECT_THAT(refused(light + 16, std::uint16_t{0x7c00}), HasSubstr("flux values that are negative"));
    EXPECT_THAT(refused(light + 16, std::uint16_t{0x8001}), HasSubstr("flux values that are negative"));
    EXPECT_THAT(refused(positions, std::uint64_t{1} << 63), HasSubstr("bytes left"));
    EXPECT_THAT(refused(environment, std::uint32_t{17}), HasSubstr("power of two"));
    EXPECT_THAT(refused(environment, std::uint32_t{1} << 31), HasSubstr("power of two"));
    EXPECT_THAT(refused(environment + 4, std::uint32_t{99}), HasSubstr("99 levels"));
    EXPECT_THAT(refused(environment + 8, -1.0f), HasSubstr("scale"));
    EXPECT_THAT(refused(environment + 8 + 4 + 8, std::uint16_t{0x7c00}),
                HasSubstr("environment values that are negative"));
    EXPECT_THAT(refused(environment + 8 + 4 + 8, std::uint16_t{0x8001}),
                HasSubstr("environment values that are negative"));
}

/// Else sums over it overflow, and the program ends at a check.
TEST(LightProbe, LightWhoseSumsWouldOverflowIsRefused) {
    image::Image image{2, 1, {{1, 1, 1}, {1, 1, kLargestRadiance}}};
    LightProbeSettings settings;
    settings.bands = 3;
    settings.key_lights = 0;
    const auto build = [&] { build_light_probe({image, Mapping::Equirectangular, "sun.hdr"}, settings); };
    EXPECT_NO_THROW(build());
    image.texels[1].y = 2.0F * kLargestRadiance;
    EXPECT_THAT(test::message_of(build), testing::StartsWith("sun.hdr: column 1, row 0: a radiance of 2e+30"));
}

TEST(LightProbe, MoreKeyLightsThanShadersTakeAreRefused) {
    LightProbe probe = small_probe();
    probe.key_lights.assign(kMaximumKeyLights, KeyLight{{0.0, 1.0, 0.0}, glm::dvec3(1.0), 50.0});
    EXPECT_EQ(deserialise(serialise(probe), "full.probe").key_lights.size(), std::size_t{kMaximumKeyLights});
    probe.key_lights.emplace_back();
    EXPECT_THROW(deserialise(serialise(probe), "more.probe"), Error);
}

TEST(LightProbe, DescriptionNamesWhatItHolds) {
    const std::string text = describe(small_probe());
    EXPECT_THAT(text, HasSubstr("bands: 6"));
    EXPECT_THAT(text, HasSubstr("illuminant: lamp.csv"));
    EXPECT_THAT(text, HasSubstr("ambient window: "));
    EXPECT_THAT(text, HasSubstr("key lights: "));
    EXPECT_THAT(text, HasSubstr("strongest key light: direction "));
    EXPECT_THAT(text, HasSubstr("light texels: 8 x 8 x 6, 3072 bytes"));
    EXPECT_THAT(text, HasSubstr("16 x 16 x 6"));
    EXPECT_THAT(text, HasSubstr("negative"));
}

/// SH of a point light of unit irradiance in direction d.
ShLight point_light(const glm::dvec3& d, double ambient_radiance) {
    ShLight light{4, std::vector<glm::dvec3>(16)};
    std::vector<double> y(16);
    math::evaluate_sh(d, 4, y);
    for (std::size_t i = 0; i < y.size(); ++i) light.coefficients[i] = glm::dvec3(y[i]);
    light.coefficients[0] += ambient_radiance * std::sqrt(4 * pi);
    return light;
}

double lowest(const AmbientLight& ambient) {
    double value = 1e30;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 e = test::evaluate_irradiance(ambient, test::spread_direction(i, 20000));
        value = std::min({value, e.x, e.y, e.z});
    }
    return value;
}

TEST(Ambient, WhiteFurnaceIsOne) {
    for (const Mapping mapping : test::kMappings) {
        const AmbientLight ambient = ambient_coefficients(project(test::constant_probe(mapping, 128), 5));
        EXPECT_EQ(ambient.window.window, math::SphericalWindow::None);
        EXPECT_EQ(ambient.window.damping, 0);
        for (int i = 0; i < 50; ++i)
            // The projection's own error at this size.
            EXPECT_NEAR(test::evaluate_irradiance(ambient, test::spread_direction(i, 50)).y, 1, 1e-3);
    }
}

TEST(Ambient, AgreesWithBruteForceIrradianceForSmoothLight) {
    // Light of three bands: nine terms are exact, whatever the projection keeps.
    const ProbeImage probe = test::made_probe(Mapping::Equirectangular, 64, [](const glm::dvec3& d) {
        return glm::dvec3(2 + d.x, 2 + d.y * d.z, 3 - d.z + d.x * d.x);
    });
    const AmbientLight ambient = ambient_coefficients(project(probe, 5));
    ASSERT_EQ(ambient.window.window, math::SphericalWindow::None);
    for (int i = 0; i < 30; ++i) {
        const glm::dvec3 n = test::spread_direction(i, 30);
        glm::dvec3 sum(0.0);
        for (int row = 0; row < 64; ++row)
            for (int column = 0; column < 128; ++column) {
                const double cosine = glm::dot(n, probe.direction(column + 0.5, row + 0.5));
                if (cosine > 0)
                    sum += cosine * probe.solid_angle(column, row) / pi * glm::dvec3(probe.image().at(column, row));
            }
        // Midpoint sums over texels of 2.8°, with a kink at the horizon.
        EXPECT_LT(glm::length(test::evaluate_irradiance(ambient, n) - sum), 0.005);
    }
}

TEST(Ambient, CosineLobeIsConvolvedWithTheCosine) {
    // Light max(0, cos) around g. E/π at angle β from g is (sin β + (π − β) cos β) · 2 / (3π): the cosine lobe's
    // autocorrelation (Lambert's sphere phase function). Three bands carry it to 1 %, but dip to −.005 behind: a little
    // light all around spares the window.
    constexpr double kAround = 0.05;
    const glm::dvec3 g = glm::normalize(glm::dvec3(1, 2, -0.5));
    const ProbeImage probe = test::made_probe(Mapping::Equirectangular, 128, [&](const glm::dvec3& d) {
        return glm::dvec3(kAround + std::max(0.0, glm::dot(g, d)));
    });
    const AmbientLight ambient = ambient_coefficients(project(probe, 5));
    ASSERT_EQ(ambient.window.window, math::SphericalWindow::None);
    const glm::dvec3 side = glm::normalize(glm::cross(g, glm::dvec3(0, 0, 1)));
    for (const double beta : {0.0, 0.7, pi / 2, 2.2}) {
        const double exact = kAround + (std::sin(beta) + (pi - beta) * std::cos(beta)) * 2 / (3 * pi);
        const glm::dvec3 n = std::cos(beta) * g + std::sin(beta) * side;
        EXPECT_NEAR(test::evaluate_irradiance(ambient, n).x, exact, 0.01) << beta;
    }
}

TEST(Ambient, MildestWindowThatKeepsItNonNegativeIsPicked) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(1, 1, -2));
    // Radiance 1/4π all around is what a point light of irradiance 1 spreads over the sphere on average.
    const auto picked = [&](double irradiance) { return ambient_coefficients(point_light(d, irradiance / (4 * pi))); };
    const AmbientLight bright = picked(2);
    EXPECT_EQ(bright.window.window, math::SphericalWindow::None);
    EXPECT_EQ(bright.window.damping, 0);

    // Unwindowed it dips to −.158 of the mean, under Lanczos to −.137.
    const AmbientLight dusk = picked(0.148);
    EXPECT_EQ(dusk.window.window, math::SphericalWindow::Lanczos);
    EXPECT_GE(lowest(dusk), 0);

    const AmbientLight night = picked(0);
    EXPECT_GT(night.window.damping, 0);
    EXPECT_GE(lowest(night), 0);
    EXPECT_GT(test::evaluate_irradiance(night, d).x, test::evaluate_irradiance(night, -d).x);
}

TEST(Ambient, WhatLobesLeaveMayBeNegativeWhereTheSumIsNot) {
    // An even light less a lobe that is as bright on average: −d reflects the difference of the two.
    const glm::dvec3 d = glm::normalize(glm::dvec3(1, 1, -2));
    const std::vector<KeyLight> keys{{d, glm::dvec3(4 * pi), 40.0}};
    const ShLight even{3, {glm::dvec3(2 * std::sqrt(4 * pi)), {}, {}, {}, {}, {}, {}, {}, {}}};
    const ShLight left = residual(even, keys, 3);
    EXPECT_TRUE(ambient_coefficients(left).window.window != math::SphericalWindow::None ||
                ambient_coefficients(left).window.damping > 0);
    const AmbientLight ambient = ambient_coefficients(left, keys);
    EXPECT_EQ(ambient.window.window, math::SphericalWindow::None);
    EXPECT_EQ(ambient.window.damping, 0);
    // The sum is the even light again, but for the lobe's bands from 4 on, E/π = flux A_l (2l+1)/4π² each under the
    // lobe: −0.29 of band 4 and 0.12 of band 6.
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 n = test::spread_direction(i, 50);
        EXPECT_NEAR(test::evaluate_irradiance(ambient, n).x + LobeIrradiance(keys)(n).x / pi, 2.0, 0.35) << i;
    }
}

TEST(Ambient, DarknessStaysDark) {
    const ShLight light{3, std::vector<glm::dvec3>(9, glm::dvec3(0.0))};
    EXPECT_EQ(test::evaluate_irradiance(ambient_coefficients(light), {0, 1, 0}), glm::dvec3(0.0));
}

}  // namespace

}  // namespace rowland::lighting
