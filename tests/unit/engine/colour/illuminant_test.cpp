#include "engine/colour/illuminant.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/colour/light_spectra.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace rowland::colour {
namespace {

using ::testing::HasSubstr;

std::string illuminant_refusal(const std::string& text) {
    try {
        parse_illuminant(text, "lamp.csv");
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

/// Published chromaticities for the 2° observer (CIE 15), four digits; 1e-3 covers 5 nm tables and the 380–780 nm
/// range.
TEST(Illuminant, BuiltInOnesHaveTheirPublishedWhite) {
    const auto expect_white = [](const std::string& name, double x, double y) {
        const LightSpectra spectra{illuminant(name)};
        const glm::dvec3 xyz = rgb_to_xyz(spectra, glm::dvec3(1.0));
        const double sum = xyz.x + xyz.y + xyz.z;
        EXPECT_NEAR(xyz.x / sum, x, 1e-3) << name;
        EXPECT_NEAR(xyz.y / sum, y, 1e-3) << name;
    };
    expect_white("A", 0.44757, 0.40745);
    expect_white("D65", 0.31272, 0.32903);
    expect_white("E", 0.33333, 0.33333);
    expect_white("F2", 0.37208, 0.37529);
    expect_white("F11", 0.38052, 0.37713);
    expect_white("LED-B3", 0.3756, 0.3723);
}

TEST(Illuminant, UnknownNameListsTheKnownOnes) {
    try {
        illuminant("D50");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("D65"));
    }
}

TEST(Illuminant, RefusesWhatIsNoLamp) {
    EXPECT_THAT(illuminant_refusal("wavelength_nm,relative_power\n400,1\n500,-2\n"), HasSubstr("lamp.csv: 500 nm"));
    EXPECT_THAT(illuminant_refusal("wavelength_nm,relative_power\n400,0\n500,0\n"), HasSubstr("no visible power"));
    EXPECT_THAT(illuminant_refusal("wavelength_nm,relative_power\n400,1e308\n600,1e308\n"),
                HasSubstr("no visible power"));
    EXPECT_THAT(illuminant_refusal("wavelength_nm,relative_power\n400,1e-320\n600,1e-320\n"),
                HasSubstr("no visible power"));
    EXPECT_THAT(illuminant_refusal("wavelength_nm,relative_power\n0.4,1\n0.7,1\n"), HasSubstr("nanometres"));
}

TEST(Illuminant, LoadsAFileAndNamesAMissingOne) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "lamp.csv";
    write_file_atomic(path, std::string_view("wavelength_nm,relative_power\n400,1\n700,1\n"));
    EXPECT_EQ(load_illuminant(path).power(550.0), 1.0);
    EXPECT_EQ(load_illuminant(path).power(701.0), 0.0);
    EXPECT_THROW(load_illuminant(folder.path() / "none.csv"), Error);
}

TEST(Illuminant, LoadsTheMeasuredLamps) {
    for (const char* name :
         {"mercury", "3led_457_540_605", "triphosphor_fl", "phosphor_led_yag", "LPS_low_pressure_sodium"}) {
        ROWLAND_TEST_DATA(path, std::string("data/lamps/nist_") + name + ".csv");
        EXPECT_GT(luminous_power(load_illuminant(path)), 0.0);
    }
}

TEST(Illuminant, IsWrittenToTheSameNumbers) {
    for (const std::string& name : illuminant_names()) {
        const Illuminant original = illuminant(name);
        const Illuminant again = parse_illuminant(write_illuminant_csv(original), "again.csv");
        EXPECT_EQ(again.power.wavelengths_nm(), original.power.wavelengths_nm()) << name;
        EXPECT_EQ(again.power.values(), original.power.values()) << name;
    }
}

}  // namespace
}  // namespace rowland::colour
