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

LightProbe small_probe() {
    const ProbeImage probe = test::made_probe(Mapping::Equirectangular, 32, [](const glm::dvec3& d) {
        return glm::dvec3(std::exp(3 * d.x), 1 + d.y, d.z > 0.9 ? 500.0 : -1.0);
    });
    return build_light_probe(probe, {.bands = 6, .prefilter = {.face_size = 16}});
}

TEST(LightProbe, SurvivesSerialisation) {
    const LightProbe probe = small_probe();
    const LightProbe read = deserialise(serialise(probe), "a.probe");
    EXPECT_EQ(read.sh.bands, 6);
    EXPECT_EQ(read.sh.coefficients, probe.sh.coefficients);
    EXPECT_EQ(read.environment.layout, probe.environment.layout);
    EXPECT_EQ(read.environment.scale, probe.environment.scale);
    EXPECT_EQ(read.environment.halves, probe.environment.halves);
    EXPECT_GT(probe.report.negative, 0u);
    EXPECT_EQ(read.report.negative, probe.report.negative);
    EXPECT_EQ(read.ambient.coefficients, probe.ambient.coefficients);
    EXPECT_EQ(read.ambient.window.window, probe.ambient.window.window);
    EXPECT_EQ(read.ambient.window.damping, probe.ambient.window.damping);
}

TEST(LightProbe, BytesDoNotDependOnTheNumberOfThreads) {
    std::vector<std::vector<std::byte>> bytes;
    for (const unsigned threads : {1u, 2u}) {
        const ThreadLimit limit(threads);
        bytes.push_back(serialise(small_probe()));
    }
    EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(LightProbe, StoredShIsRawRadiance) {
    const LightProbe probe = build_light_probe(test::constant_probe(Mapping::Equirectangular, 32));
    EXPECT_EQ(probe.sh.bands, 16);
    EXPECT_NEAR(probe.sh.coefficients[0].x, std::sqrt(4 * std::numbers::pi), 1e-12);
    EXPECT_NEAR(probe.ambient.coefficients[0].x, std::sqrt(4 * std::numbers::pi), 1e-12);  // A_0/π = 1
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
    const auto bytes = serialise(small_probe());
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
    const std::size_t environment = 4 + 8 + 36 * 24;
    EXPECT_THAT(refused(0, std::uint32_t{0}), ::testing::HasSubstr("0 bands"));
    EXPECT_THAT(refused(0, std::uint32_t{33}), ::testing::HasSubstr("33 bands"));
    EXPECT_THAT(refused(0, std::uint32_t{7}), ::testing::HasSubstr("for 7 bands"));
    EXPECT_THAT(refused(4, std::uint64_t{1} << 62), ::testing::HasSubstr("bytes left"));
    EXPECT_THAT(refused(12, std::nan("")), ::testing::HasSubstr("not finite"));
    EXPECT_THAT(refused(environment, std::uint32_t{17}), ::testing::HasSubstr("power of two"));
    EXPECT_THAT(refused(environment, std::uint32_t{1} << 31), ::testing::HasSubstr("power of two"));
    EXPECT_THAT(refused(environment + 4, std::uint32_t{99}), ::testing::HasSubstr("99 levels"));
    EXPECT_THAT(refused(environment + 8, -1.0f), ::testing::HasSubstr("scale"));
    EXPECT_THAT(refused(environment + 8 + 4 + 8, std::uint16_t{0x7c00}), ::testing::HasSubstr("no light"));
    EXPECT_THAT(refused(environment + 8 + 4 + 8, std::uint16_t{0x8001}), ::testing::HasSubstr("no light"));
}

TEST(LightProbe, FlippedBytesNeverCrash) {
    const auto original = serialise(small_probe());
    std::mt19937 random(5);
    for (int round = 0; round < 300; ++round) {
        auto bytes = original;
        for (int k = 0; k < 3; ++k) bytes[random() % 1000] = static_cast<std::byte>(random());
        try {
            deserialise(bytes, "flipped.probe");
        } catch (const Error&) {
            // refused is fine
        }
    }
}

TEST(LightProbe, DescriptionNamesWhatItHolds) {
    const std::string text = describe(small_probe());
    EXPECT_THAT(text, ::testing::HasSubstr("bands: 6"));
    EXPECT_THAT(text, ::testing::HasSubstr("ambient window: "));
    EXPECT_THAT(text, ::testing::HasSubstr("16 x 16 x 6"));
    EXPECT_THAT(text, ::testing::HasSubstr("negative"));
}

}  // namespace
}  // namespace rowland::lighting
