#include <gmock/gmock.h>

#include <array>

#include "engine/colour/colour_space.h"
#include "tests/support/environment.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/unit/engine/post/config_variant.h"

namespace rowland::post {

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// $OCIO for the length of a test.
class OcioVariable {
 public:
    explicit OcioVariable(const std::string& value) {
        if (const char* before = std::getenv("OCIO")) before_ = before;
        test::set_variable("OCIO", value);
    }
    ~OcioVariable() {
        if (before_) {
            test::set_variable("OCIO", *before_);
        } else {
            test::set_variable("OCIO", std::nullopt);
        }
    }
    OcioVariable(const OcioVariable&) = delete;
    OcioVariable& operator=(const OcioVariable&) = delete;

 private:
    std::optional<std::string> before_;
};

template <typename Load>
std::string failure(const Load& load) {
    return test::message_of([&] { load(); });
}

TEST(OcioConfig, ShippedOneHasItsDisplayViewsAndRoles) {
    const OcioConfig config = OcioConfig::shipped();
    EXPECT_THAT(config.displays(), ElementsAre("sRGB - Display", "Rec.2100-PQ - Display", "Rec.2100-HLG - Display"));
    EXPECT_THAT(config.views("sRGB - Display"),
                ElementsAre("Constant Hue", "ACES 1.0 - SDR Video", "AgX", "False Colour", "Un-tone-mapped", "Raw"));
    EXPECT_THAT(config.views("Rec.2100-PQ - Display"), ElementsAre("ACES 1.1 - HDR Video", "Raw"));
    EXPECT_EQ(config.default_display(), "sRGB - Display");
    EXPECT_EQ(config.default_view("sRGB - Display"), "Constant Hue");
    EXPECT_STREQ(config.ocio()->getColorSpace("scene_linear")->getName(), "ACEScg");
    EXPECT_STREQ(config.ocio()->getColorSpace("aces_interchange")->getName(), "ACES2065-1");
    EXPECT_TRUE(config.ocio()->getColorSpace("data")->isData());
}

TEST(OcioConfig, PathComesBeforeTheVariableBeforeTheShippedOne) {
    const test::TemporaryFolder first;
    const test::TemporaryFolder second;
    const auto by_path = test::write_variant(first.path(), {{"name: rowland", "name: by path"}});
    const auto by_variable = test::write_variant(second.path(), {{"name: rowland", "name: by variable"}});
    {
        const OcioVariable variable(by_variable.string());
        EXPECT_STREQ(OcioConfig::choose(by_path).ocio()->getName(), "by path");
        EXPECT_STREQ(OcioConfig::choose().ocio()->getName(), "by variable");
        EXPECT_THAT(OcioConfig::choose().source(), HasSubstr("variant.ocio (named by $OCIO)"));
    }
    const OcioVariable empty("");
    EXPECT_STREQ(OcioConfig::choose().ocio()->getName(), "rowland");
}

TEST(OcioConfig, PreferredDisplayAndViewAreTheDefaults) {
    OcioConfig config = OcioConfig::shipped();
    config.prefer("", "AgX");
    EXPECT_EQ(config.default_display(), "sRGB - Display");
    EXPECT_EQ(config.default_view("sRGB - Display"), "AgX");
    EXPECT_EQ(config.default_view("Rec.2100-PQ - Display"), "ACES 1.1 - HDR Video");
    config.prefer("Rec.2100-PQ - Display", "");
    EXPECT_EQ(config.default_display(), "Rec.2100-PQ - Display");
    EXPECT_EQ(config.default_view("Rec.2100-PQ - Display"), "ACES 1.1 - HDR Video");
    EXPECT_THAT(failure([&] { config.prefer("", "AgX"); }), HasSubstr("no view \"AgX\""));
    EXPECT_THAT(failure([&] { config.prefer("rec2100", ""); }), HasSubstr("no display \"rec2100\""));
}

TEST(OcioConfig, AFileIsLeftAsItIs) {
    const test::TemporaryFolder folder;
    const OcioConfig config = OcioConfig::from_file(test::write_variant(folder.path(), {}));
    EXPECT_EQ(config.default_view("sRGB - Display"), "ACES 1.0 - SDR Video");
    EXPECT_THAT(config.views("sRGB - Display"), ElementsAre("ACES 1.0 - SDR Video", "Un-tone-mapped", "Raw"));
}

TEST(OcioConfig, MissingFileIsNamedWithWhereItsNameCameFrom) {
    EXPECT_THAT(failure([] { OcioConfig::from_file("/no/such.ocio"); }), HasSubstr("/no/such.ocio: no such file"));
    const OcioVariable variable("/no/such.ocio");
    EXPECT_THAT(failure([] { OcioConfig::choose(); }), HasSubstr("/no/such.ocio (named by $OCIO): no such file"));
}

TEST(OcioConfig, LaterVersionIsRefusedWithBothVersions) {
    const test::TemporaryFolder folder;
    for (const auto& [line, found] : {std::pair{"ocio_profile_version: 2.99", "a configuration of version 2.99"},
                                      std::pair{"ocio_profile_version: 3", "a configuration of version 3.0"}}) {
        const auto path = test::write_variant(folder.path(), {{"ocio_profile_version: 2.1", line}});
        const std::string message = failure([&] { OcioConfig::from_file(path); });
        EXPECT_THAT(message, HasSubstr(found));
        EXPECT_THAT(message,
                    HasSubstr(std::string("the latest OpenColorIO ") + OCIO_NAMESPACE::GetVersion() + " reads"));
        EXPECT_THAT(message, HasSubstr("variant.ocio"));
    }
}

TEST(OcioConfig, BuiltInNamesAreExplainedWhereThereAreNone) {
    if (OCIO_NAMESPACE::GetVersionHex() >= 0x02020000) GTEST_SKIP() << "this OpenColorIO has configurations built in";
    const OcioVariable variable("ocio://default");
    EXPECT_THAT(failure([] { OcioConfig::choose(); }), HasSubstr("has none built in"));
}

TEST(OcioConfig, WhatIsNoConfigurationIsRefused) {
    const test::TemporaryFolder folder;
    for (const char* text : {"", "not a configuration", "ocio_profile_version: [", "ocio_profile_version: 2.1\n",
                             "ocio_profile_version: 2.1\nroles: {scene_linear: nowhere}\n", "{\"json\": 1}"}) {
        write_file_atomic(folder.path() / "bad.ocio", text);
        EXPECT_THAT(failure([&] { OcioConfig::from_file(folder.path() / "bad.ocio"); }), HasSubstr("bad.ocio")) << text;
    }
}

TEST(OcioConfig, AViewWithoutItsColourSpaceIsRefusedAtOnce) {
    const test::TemporaryFolder folder;
    const auto path =
        test::write_variant(folder.path(), {{"{name: Raw, colorspace: Raw}", "{name: Raw, colorspace: Row}"}});
    EXPECT_THAT(failure([&] { OcioConfig::from_file(path); }), HasSubstr("Row"));
}

TEST(OcioConfig, UnknownDisplayListsThoseThereAre) {
    const std::string message = failure([] { (void)OcioConfig::shipped().views("sRBG - Display"); });
    EXPECT_THAT(message, HasSubstr("no display \"sRBG - Display\""));
    EXPECT_THAT(message, HasSubstr("did you mean \"sRGB - Display\"?"));
}

TEST(OcioConfig, ReadsTheAcesConfigurations) {
    for (const char* name :
         {"ocio/aces_configs/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio",
          "ocio/aces_configs/studio-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio", "ocio/aces_configs/ocio-v2_demo.ocio"}) {
        ROWLAND_TEST_DATA(path, name);
        EXPECT_FALSE(OcioConfig::from_file(path).displays().empty()) << name;
    }
}

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
    EXPECT_THAT(test::message_of([&] { (void)xyz_to_scene_linear(OcioConfig::from_file(path)); }),
                HasSubstr("a colour space that is not linear"));
}

}  // namespace

}  // namespace rowland::post
