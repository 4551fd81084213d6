#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/post/display_pass.h"

#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/unit/engine/post/config_variant.h"
#include "tests/unit/engine/post/cpu_effects.h"

namespace rowland::post {

namespace {

using ::testing::HasSubstr;

glm::vec3 shown(const DisplayTransform& transform, glm::vec3 colour, float stops = 0.0F) {
    transform.apply_cpu(std::span<glm::vec3>(&colour, 1), stops);
    return colour;
}

std::string failure(const OcioConfig& config, const DisplaySelection& selection) {
    return test::message_of([&] { const DisplayTransform transform(config, selection); });
}

/// ACES 1.3 Reference Gamut Compression of an ACEScg colour: LMT.Academy.GamutCompress.ctl, written out.
glm::dvec3 gamut_compressed(const glm::dvec3& colour) {
    constexpr double power = 1.2;
    const std::array threshold{0.815, 0.803, 0.880};
    const std::array limit{1.147, 1.264, 1.312};
    const double achromatic = std::max({colour.r, colour.g, colour.b});
    glm::dvec3 result(0.0);
    for (int c = 0; c < 3; ++c) {
        const double t = threshold[static_cast<std::size_t>(c)];
        const double l = limit[static_cast<std::size_t>(c)];
        double distance = (achromatic - colour[c]) / std::abs(achromatic);
        if (distance >= t) {
            const double scale = (l - t) / std::pow(std::pow((1.0 - t) / (l - t), -power) - 1.0, 1.0 / power);
            const double over = (distance - t) / scale;
            distance = t + scale * over / std::pow(1.0 + std::pow(over, power), 1.0 / power);
        }
        result[c] = achromatic - distance * std::abs(achromatic);
    }
    return result;
}

TEST(DisplayTransform, NeutralsComeOutAsTheAcesOutputTransformHasThem) {
    const DisplayTransform transform(OcioConfig::shipped(), {"", "ACES 1.0 - SDR Video"});
    for (int c = 0; c < 3; ++c) {
        // Published to five digits; OpenColorIO's curves are good to 1e-5.
        EXPECT_NEAR(shown(transform, glm::vec3(0.18F))[c], 0.35595F, 2e-5F);
        EXPECT_NEAR(shown(transform, glm::vec3(1.0F))[c], 0.81197F, 2e-5F);
    }
}

TEST(DisplayTransform, AcesViewCompressesTheGamutFirst) {
    ROWLAND_TEST_DATA(path, "ocio/aces_configs/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio");
    const DisplayTransform ours(OcioConfig::shipped(), {"", "ACES 1.0 - SDR Video"});
    const DisplayTransform plain(OcioConfig::from_file(path), {"sRGB - Display", "ACES 1.0 - SDR Video"});
    // Spectral colours of a grating: outside the gamut, with negative components; and one inside.
    for (const glm::dvec3& colour : {glm::dvec3(0.9, -0.12, 0.02), glm::dvec3(-0.1, 0.5, -0.05),
                                     glm::dvec3(0.01, -0.06, 0.7), glm::dvec3(0.3, 0.4, 0.2)}) {
        const glm::vec3 with_ours = shown(ours, glm::vec3(colour));
        const glm::vec3 by_hand = shown(plain, glm::vec3(gamut_compressed(colour)));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(with_ours[c], by_hand[c], 5e-5F);  // OpenColorIO's fast log and pow
    }
    const glm::vec3 outside(0.9F, -0.12F, 0.02F);
    EXPECT_GT(glm::distance(shown(ours, outside), shown(plain, outside)), 0.01F);
}

TEST(DisplayTransform, UnToneMappedViewIsTheSrgbCurve) {
    const DisplayTransform transform(OcioConfig::shipped(), {"sRGB - Display", "Un-tone-mapped"});
    for (const double linear : {0.001, 0.18, 0.5, 1.0}) {
        const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
        // A neutral of ACEScg is a neutral of sRGB; OpenColorIO's pow and IEC 61966-2-1's rounded constants.
        EXPECT_NEAR(shown(transform, glm::vec3(static_cast<float>(linear))).g, encoded, 2e-5);
    }
}

TEST(DisplayTransform, RawViewShowsTheNumbers) {
    const DisplayTransform transform(OcioConfig::shipped(), {"sRGB - Display", "Raw"});
    EXPECT_EQ(shown(transform, {0.25F, -2.0F, 300.0F}), glm::vec3(0.25F, -2.0F, 300.0F));
}

TEST(DisplayTransform, ExposureIsAFactorOnSceneLinearLight) {
    const DisplayTransform transform(OcioConfig::shipped());
    const glm::vec3 exposed = shown(transform, {0.1F, 0.2F, 0.05F}, 1.5F);
    const glm::vec3 scaled = shown(transform, glm::vec3(0.1F, 0.2F, 0.05F) * std::exp2(1.5F));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(exposed[c], scaled[c], 1e-6F);  // one rounding more
    // The exposure of one call is not that of the next.
    EXPECT_EQ(shown(transform, glm::vec3(0.18F), 0.0F), shown(transform, glm::vec3(0.18F)));
    EXPECT_GT(exposed.g, shown(transform, {0.1F, 0.2F, 0.05F}).g + 0.1F);
}

TEST(DisplayTransform, NonFiniteLightIsShownAsFiniteValues) {
    const float infinity = std::numeric_limits<float>::infinity();
    const DisplayTransform transform(OcioConfig::shipped());
    EXPECT_GE(shown(transform, glm::vec3(infinity)).g, 0.999F);
    const DisplayTransform raw(OcioConfig::shipped(), {"", "Raw"});
    const float not_a_number = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(shown(raw, {not_a_number, infinity, -infinity}), glm::vec3(0.0F, 65504.0F, -65504.0F));
}

TEST(DisplayTransform, EmptyNamesMeanTheDefaults) {
    const DisplayTransform transform(OcioConfig::shipped());
    EXPECT_EQ(transform.display(), "sRGB - Display");
    EXPECT_EQ(transform.view(), "Constant Hue");
}

TEST(DisplayTransform, UnknownViewListsThoseThereAreAndNamesTheNearest) {
    const std::string message = failure(OcioConfig::shipped(), {"sRGB - Display", "Untone-mapped"});
    EXPECT_THAT(message, HasSubstr("no view \"Untone-mapped\""));
    EXPECT_THAT(message, HasSubstr("\"False Colour\", \"Un-tone-mapped\", \"Raw\""));
    EXPECT_THAT(message, HasSubstr("did you mean \"Un-tone-mapped\"?"));
}

TEST(DisplayTransform, ConfigurationWithoutSceneLinearIsRefused) {
    const test::TemporaryFolder folder;
    const auto path = test::write_variant(folder.path(), {{"  scene_linear: ACEScg\n", ""}});
    EXPECT_THAT(failure(OcioConfig::from_file(path), {}), HasSubstr("no scene_linear"));
}

TEST(DisplayTransform, MissingTableIsNamed) {
    const test::TemporaryFolder folder;
    const auto path = test::write_variant(
        folder.path(), {{"search_path: \"\"", "search_path: ."},
                        {"from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}",
                         "from_display_reference: !<FileTransform> {src: lost.spi1d}"}});
    EXPECT_THAT(failure(OcioConfig::from_file(path), {}), HasSubstr("lost.spi1d"));
}

/// What an 8-bit target holds, in its steps.
float stored(float value) {
    return std::round(255.0F * std::min(std::max(value, 0.0F), 1.0F));
}

/// The mean of a dithered picture of one value, in 8-bit steps.
double mean_stored(float value, glm::ivec2 size, std::uint32_t frame) {
    std::vector<glm::vec3> pixels(static_cast<std::size_t>(size.x * size.y), glm::vec3(value));
    apply_dither(pixels, size, frame, {});
    double sum = 0.0;
    for (const glm::vec3& pixel : pixels) sum += stored(pixel.g);
    return sum / static_cast<double>(pixels.size());
}

TEST(Dither, TheMeanOverAnAreaIsTheValue) {
    for (const std::uint32_t frame : {0U, 1U, 77U}) {
        for (float steps = 10.0F; steps <= 11.0F; steps += 0.03125F) {
            // 0.05 of a step: a band is visible from about ten times that.
            EXPECT_NEAR(mean_stored(steps / 255.0F, {16, 16}, frame), steps, 0.05) << frame;
        }
    }
}

TEST(Dither, TheMeanOverFramesIsTheValue) {
    for (const float steps : {100.25F, 100.5F, 100.9F}) {
        double sum = 0.0;
        for (std::uint32_t frame = 0; frame < 64; ++frame) sum += mean_stored(steps / 255.0F, {1, 1}, frame);
        EXPECT_NEAR(sum / 64.0, steps, 0.05);
    }
}

TEST(Dither, BlackAndWhiteStayAsTheyAre) {
    EXPECT_EQ(mean_stored(0.0F, {64, 64}, 3), 0.0);
    EXPECT_EQ(mean_stored(1.0F, {64, 64}, 3), 255.0);
}

TEST(Dither, NoiseStaysWithinHalfAStepAndFillsIt) {
    float lowest = 0.0F;
    float highest = 0.0F;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            lowest = std::min(lowest, dither_offset({x, y}, 5));
            highest = std::max(highest, dither_offset({x, y}, 5));
        }
    }
    EXPECT_GT(lowest, -0.5F);
    EXPECT_LT(highest, 0.5F);
    EXPECT_LT(lowest, -0.49F);
    EXPECT_GT(highest, 0.49F);
}

TEST(Dither, SameForTheSameFrameAndOtherForAnother) {
    EXPECT_EQ(dither_offset({123, 45}, 6), dither_offset({123, 45}, 6));
    EXPECT_NE(dither_offset({123, 45}, 6), dither_offset({123, 45}, 7));
    EXPECT_NE(dither_offset({123, 45}, 6), dither_offset({124, 45}, 6));
    EXPECT_NE(dither_offset({123, 45}, 6), dither_offset({123, 46}, 6));
}

TEST(Dither, StepsFollowTheTargetsBits) {
    EXPECT_FLOAT_EQ(dither_step({}), 1.0F / 255.0F);
    EXPECT_FLOAT_EQ(dither_step({.bits = 10}), 1.0F / 1023.0F);
}

TEST(Grain, IsOfMeanZeroAndVarianceOneAndOtherInEachFrame) {
    double sum = 0.0;
    double squares = 0.0;
    double with_next_pixel = 0.0;
    double with_next_frame = 0.0;
    constexpr int kSide = 200;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double here = grain_offset({x, y}, 5);
            sum += here;
            squares += here * here;
            with_next_pixel += here * grain_offset({x + 1, y}, 5);
            with_next_frame += here * grain_offset({x, y}, 6);
        }
    }
    // Four deviations of means of 40 000 values, of which about 3 x 3 are one.
    constexpr double kTolerance = 4.0 * 3.0 / kSide;
    constexpr double kCount = kSide * kSide;
    EXPECT_NEAR(sum / kCount, 0.0, kTolerance);
    EXPECT_NEAR(squares / kCount, 1.0, kTolerance);
    EXPECT_NEAR(with_next_pixel / kCount, 4.0 / 6.0, kTolerance);  // of the weights 1, 2, 1
    EXPECT_NEAR(with_next_frame / kCount, 0.0, kTolerance);
}

TEST(DitherDeathTest, BitsOutOfRangeAreALogicError) {
    EXPECT_DEATH((void)dither_step({.bits = 0}), "settings.bits >= 1");
    EXPECT_DEATH((void)dither_step({.bits = 13}), "settings.bits <= 12");
}

}  // namespace

}  // namespace rowland::post
