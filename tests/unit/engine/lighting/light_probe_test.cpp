#include "engine/lighting/light_probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {
namespace {

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
    EXPECT_EQ(read.sh.bands, 6);
    EXPECT_EQ(read.sh.coefficients, probe.sh.coefficients);
    EXPECT_EQ(probe.illuminant.name, "lamp.csv");
    EXPECT_EQ(read.illuminant.name, "lamp.csv");
    EXPECT_EQ(read.illuminant.power.wavelengths_nm(), lamp().power.wavelengths_nm());
    EXPECT_EQ(read.illuminant.power.values(), lamp().power.values());
    EXPECT_EQ(read.illuminant.power(400.0), 0.0);
    ASSERT_GE(probe.key_lights.size(), 1u);
    ASSERT_EQ(read.key_lights.size(), probe.key_lights.size());
    for (std::size_t i = 0; i < read.key_lights.size(); ++i) {
        EXPECT_EQ(read.key_lights[i].direction, probe.key_lights[i].direction);
        EXPECT_EQ(read.key_lights[i].flux, probe.key_lights[i].flux);
        EXPECT_EQ(read.key_lights[i].concentration, probe.key_lights[i].concentration);
    }
    EXPECT_EQ(probe.light.face_size, 8);
    EXPECT_EQ(read.light.face_size, 8);
    EXPECT_EQ(read.light.scale, probe.light.scale);
    EXPECT_EQ(read.light.halves, probe.light.halves);
    EXPECT_EQ(read.light.positions, probe.light.positions);
    EXPECT_EQ(read.environment.layout, probe.environment.layout);
    EXPECT_EQ(read.environment.scale, probe.environment.scale);
    EXPECT_EQ(read.environment.halves, probe.environment.halves);
    ASSERT_TRUE(read.dome);
    EXPECT_EQ(read.dome->height_m, 1.5);
    EXPECT_EQ(read.dome->radius_m, 6.0);
    EXPECT_GT(probe.report.negative, 0u);
    EXPECT_EQ(read.report.negative, probe.report.negative);
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
    std::vector<std::vector<std::byte>> bytes;
    for (const unsigned threads : {1u, 2u}) {
        const ThreadLimit limit(threads);
        bytes.push_back(serialise(build_small_probe()));
    }
    EXPECT_EQ(bytes[0], bytes[1]);
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
        try {
            deserialise(changed, "bad.probe");
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("was not refused");
    };
    const std::size_t name = 4 + 8 + 36 * 24;
    const std::size_t wavelengths = name + 8 + 8;  // "lamp.csv"
    const std::size_t power = wavelengths + 8 + 24;
    const std::size_t keys = power + 8 + 24;
    const std::size_t light = keys + 8 + probe.key_lights.size() * 56;
    const std::size_t places = light + 4 + 4 + 8 + std::size_t{18} * 8 * 8 * 2;
    const std::size_t environment = places + 8 + std::size_t{12} * 8 * 8;
    EXPECT_THAT(refused(0, std::uint32_t{0}), ::testing::HasSubstr("0 bands"));
    EXPECT_THAT(refused(0, std::uint32_t{33}), ::testing::HasSubstr("33 bands"));
    EXPECT_THAT(refused(0, std::uint32_t{7}), ::testing::HasSubstr("for 7 bands"));
    EXPECT_THAT(refused(4, std::uint64_t{1} << 62), ::testing::HasSubstr("bytes left"));
    EXPECT_THAT(refused(12, std::nan("")), ::testing::HasSubstr("not finite"));
    EXPECT_THAT(refused(name, std::uint64_t{0}), ::testing::HasSubstr("name of 0 bytes"));
    EXPECT_THAT(refused(name, std::uint64_t{1} << 60), ::testing::HasSubstr("bytes left"));
    EXPECT_THAT(refused(wavelengths, std::uint64_t{1} << 60), ::testing::HasSubstr("bytes left"));
    for (const double bad : {0.0, -5.0, 600.0, std::nan(""), HUGE_VAL})
        EXPECT_THAT(refused(wavelengths + 8, bad), ::testing::HasSubstr("ascending wavelengths")) << bad;
    for (const double bad : {-1.0, std::nan(""), HUGE_VAL})
        EXPECT_THAT(refused(power + 8, bad), ::testing::HasSubstr("a power >= 0")) << bad;
    EXPECT_THAT(refused(power + 8, 1e308), ::testing::HasSubstr("without visible power"));
    EXPECT_THAT(refused(keys, std::uint64_t{6}), ::testing::HasSubstr("6 numbers for key lights"));
    EXPECT_THAT(refused(keys, std::uint64_t{1} << 60), ::testing::HasSubstr("bytes left"));
    for (const double bad : {2.0, std::nan(""), HUGE_VAL})
        EXPECT_THAT(refused(keys + 8, bad), ::testing::HasSubstr("direction of another length")) << bad;
    for (const double bad : {-1.0, std::nan(""), HUGE_VAL, 1e39})
        EXPECT_THAT(refused(keys + 8 + 24, bad), ::testing::HasSubstr("flux")) << bad;
    for (const double bad : {-1.0, 0.0, std::nan(""), HUGE_VAL})
        EXPECT_THAT(refused(keys + 8 + 48, bad), ::testing::HasSubstr("concentration")) << bad;
    EXPECT_THAT(refused(light, std::uint32_t{9}), ::testing::HasSubstr("expected 1458"));
    EXPECT_THAT(refused(light, std::uint32_t{0xFFFFFFFF}), ::testing::HasSubstr("at most 1024"));
    for (const float bad : {0.0f, -1.0f, HUGE_VALF})
        EXPECT_THAT(refused(light + 4, bad), ::testing::HasSubstr("scale")) << bad;
    EXPECT_THAT(refused(light + 8, std::uint64_t{1} << 62), ::testing::HasSubstr("bytes left"));
    EXPECT_THAT(refused(light + 16, std::uint16_t{0x7c00}), ::testing::HasSubstr("flux values that are negative"));
    EXPECT_THAT(refused(light + 16, std::uint16_t{0x8001}), ::testing::HasSubstr("flux values that are negative"));
    EXPECT_THAT(refused(places, std::uint64_t{1} << 63), ::testing::HasSubstr("bytes left"));
    EXPECT_THAT(refused(environment, std::uint32_t{17}), ::testing::HasSubstr("power of two"));
    EXPECT_THAT(refused(environment, std::uint32_t{1} << 31), ::testing::HasSubstr("power of two"));
    EXPECT_THAT(refused(environment + 4, std::uint32_t{99}), ::testing::HasSubstr("99 levels"));
    EXPECT_THAT(refused(environment + 8, -1.0f), ::testing::HasSubstr("scale"));
    EXPECT_THAT(refused(environment + 8 + 4 + 8, std::uint16_t{0x7c00}),
                ::testing::HasSubstr("environment values that are negative"));
    EXPECT_THAT(refused(environment + 8 + 4 + 8, std::uint16_t{0x8001}),
                ::testing::HasSubstr("environment values that are negative"));
}

TEST(LightProbe, MoreKeyLightsThanShadersTakeAreRefused) {
    LightProbe probe = small_probe();
    probe.key_lights.assign(kMaximumKeyLights, KeyLight{{0.0, 1.0, 0.0}, glm::dvec3(1.0), 50.0});
    EXPECT_EQ(deserialise(serialise(probe), "full.probe").key_lights.size(), std::size_t{kMaximumKeyLights});
    probe.key_lights.emplace_back();
    EXPECT_THROW(deserialise(serialise(probe), "more.probe"), Error);
}

TEST(LightProbe, FlippedBytesNeverCrash) {
    const auto original = serialise(small_probe());
    std::mt19937 random(5);
    for (int round = 0; round < 300; ++round) {
        auto bytes = original;
        for (int k = 0; k < 3; ++k) bytes[random() % 1400] = static_cast<std::byte>(random());
        try {
            const LightProbe read = deserialise(bytes, "flipped.probe");
            unpack(read.light, read.key_lights);  // what is accepted can be used
        } catch (const Error&) {
            // refused is fine
        }
    }
}

TEST(LightProbe, DescriptionNamesWhatItHolds) {
    const std::string text = describe(small_probe());
    EXPECT_THAT(text, ::testing::HasSubstr("bands: 6"));
    EXPECT_THAT(text, ::testing::HasSubstr("illuminant: lamp.csv"));
    EXPECT_THAT(text, ::testing::HasSubstr("ambient window: "));
    EXPECT_THAT(text, ::testing::HasSubstr("key lights: "));
    EXPECT_THAT(text, ::testing::HasSubstr("strongest key light: direction "));
    EXPECT_THAT(text, ::testing::HasSubstr("light texels: 8 x 8 x 6, 3072 bytes"));
    EXPECT_THAT(text, ::testing::HasSubstr("16 x 16 x 6"));
    EXPECT_THAT(text, ::testing::HasSubstr("negative"));
}

}  // namespace
}  // namespace rowland::lighting
