#include "engine/post/display_transform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "engine/core/error.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"
#include "tests/unit/engine/post/config_variant.h"

namespace rowland::post {

namespace {

using ::testing::HasSubstr;

glm::vec3 shown(const DisplayTransform& transform, glm::vec3 colour, float stops = 0.0F) {
    transform.apply_cpu(std::span<glm::vec3>(&colour, 1), stops);
    return colour;
}

std::string failure(const OcioConfig& config, const DisplaySelection& selection) {
    try {
        const DisplayTransform transform(config, selection);
    } catch (const Error& error) {
        EXPECT_EQ(error.info().fault, Fault::Input);
        return error.what();
    }
    return "no failure";
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

}  // namespace

}  // namespace rowland::post
