#include "engine/post/working_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "engine/colour/working_space.h"
#include "engine/core/error.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"
#include "tests/unit/engine/post/config_variant.h"

namespace rowland::post {

namespace {

using ::testing::HasSubstr;

/// Linear Rec.709 to ACEScg with Bradford adaptation, as published in many places to ten digits (row by row).
constexpr std::array<std::array<double, 3>, 3> rec709_to_acescg{{{0.6130974024, 0.3395231462, 0.0473794514},
                                                                 {0.0701937225, 0.9163538791, 0.0134523985},
                                                                 {0.0206155929, 0.1095697729, 0.8698146342}}};
// OpenColorIO computes in float (1e-6), and our white is that of the D65 table, (0.3127, 0.3290) to four digits.
constexpr double tolerance = 1e-4;

void expect_acescg(const glm::dmat3& matrix) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            const double expected = rec709_to_acescg[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
            EXPECT_NEAR(matrix[column][row], expected, tolerance) << row << " " << column;
        }
    }
}

void expect_identity(const glm::dmat3& matrix) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            EXPECT_NEAR(matrix[column][row], row == column ? 1.0 : 0.0, tolerance) << row << " " << column;
        }
    }
}

glm::dmat3 rec709_to_scene_linear(const OcioConfig& config) {
    return xyz_to_scene_linear(config) * colour::rec709_to_xyz();
}

TEST(WorkingSpace, ShippedConfigurationWorksInAcesCg) {
    expect_acescg(rec709_to_scene_linear(OcioConfig::shipped()));
}

TEST(WorkingSpace, AcesConfigurationsWorkInAcesCg) {
    for (const char* name : {"ocio/aces_configs/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio",
                             "ocio/aces_configs/studio-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio"}) {
        ROWLAND_TEST_DATA(path, name);
        expect_acescg(rec709_to_scene_linear(OcioConfig::from_file(path)));
    }
}

TEST(WorkingSpace, WhiteStaysNeutral) {
    const glm::dvec3 white = rec709_to_scene_linear(OcioConfig::shipped()) * glm::dvec3(1.0);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1.0, 1e-6);  // the white is the same one on both sides
}

TEST(WorkingSpace, LuminanceOfTheRec709PrimariesIsAsTheStandardSays) {
    const OcioConfig config = OcioConfig::shipped();
    const glm::dvec3 weights(luminance_weights(config));
    const glm::dvec3 luminances = weights * rec709_to_scene_linear(config);
    // ITU-R BT.709, 3.2: to four digits.
    EXPECT_NEAR(luminances.r, 0.2126, tolerance);
    EXPECT_NEAR(luminances.g, 0.7152, tolerance);
    EXPECT_NEAR(luminances.b, 0.0722, tolerance);
    // In ACEScg itself they are others.
    EXPECT_GT(weights.r, 0.25);
}

TEST(WorkingSpace, FollowsTheSceneLinearRole) {
    const test::TemporaryFolder folder;
    const auto path =
        test::write_variant(folder.path(), {{"scene_linear: ACEScg", "scene_linear: Linear Rec.709 (sRGB)"}});
    expect_identity(rec709_to_scene_linear(OcioConfig::from_file(path)));
}

TEST(WorkingSpace, FindsXyzWhereThereIsNoAcesInterchange) {
    const test::TemporaryFolder folder;
    const auto path = test::write_variant(
        folder.path(), {{"  aces_interchange: ACES2065-1\n", ""},
                        {"cie_xyz_d65_interchange: CIE-XYZ-D65", "cie_xyz_d65_interchange: XYZ of the scene"},
                        {"scene_linear: ACEScg", "scene_linear: Linear Rec.709 (sRGB)"},
                        {"\ncolorspaces:\n",
                         "\ncolorspaces:\n  - !<ColorSpace>\n    name: XYZ of the scene\n"
                         "    from_scene_reference: !<BuiltinTransform> "
                         "{style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}\n\n"}});
    testing::internal::CaptureStderr();
    expect_identity(rec709_to_scene_linear(OcioConfig::from_file(path)));
    EXPECT_EQ(testing::internal::GetCapturedStderr().find("taken to be ACEScg"), std::string::npos);
}

TEST(WorkingSpace, WithoutInterchangeAcesCgIsAssumedWithAWarning) {
    const test::TemporaryFolder folder;
    const auto path = test::write_variant(folder.path(), {{"  aces_interchange: ACES2065-1\n", ""},
                                                          {"scene_linear: ACEScg", "scene_linear: ACES2065-1"}});
    testing::internal::CaptureStderr();
    expect_acescg(rec709_to_scene_linear(OcioConfig::from_file(path)));
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("scene_linear is taken to be ACEScg"));
}

TEST(WorkingSpace, ACurvedSceneLinearIsRefused) {
    const test::TemporaryFolder folder;
    const auto path = test::write_variant(folder.path(), {{"scene_linear: ACEScg", "scene_linear: sRGB - Texture"}});
    try {
        (void)xyz_to_scene_linear(OcioConfig::from_file(path));
        FAIL() << "no failure";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("a colour space that is not linear"));
    }
}

}  // namespace

}  // namespace rowland::post
