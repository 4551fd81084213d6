#include <gmock/gmock.h>

#include <functional>
#include <glm/geometric.hpp>

#include "engine/colour/colour_space.h"
#include "engine/colour/illuminant.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::colour {

namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string illuminant_refusal(const std::string& text) {
    return test::message_of([&] { parse_illuminant(text, "lamp.csv"); });
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
    EXPECT_THAT(test::message_of([] { illuminant("D50"); }), HasSubstr("D65"));
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

/// The published basis sums to 1 within 1e-5 (its printed digits).
TEST(LightSpectra, BasisFunctionsSumToOne) {
    for (int wavelength_nm = kVisibleMin; wavelength_nm <= kVisibleMax; ++wavelength_nm) {
        const glm::dvec3 basis = rgb_basis(wavelength_nm);
        EXPECT_NEAR(basis.r + basis.g + basis.b, 1.0, 1.1e-5) << wavelength_nm;
    }
}

/// Y to the basis' sum, chromaticity to the four digits that define D65 (ITU-R BT.709: 0.3127,
/// 0.3290): half a digit, and the 1e-5 that cutting the range to 380–780 nm takes.
TEST(LightSpectra, WhiteHasUnitLuminanceAndD65Chromaticity) {
    const glm::dvec3 white = rgb_to_xyz(LightSpectra(), glm::dvec3(1.0));
    EXPECT_NEAR(white.y, 1.0, 1e-5);
    EXPECT_NEAR(white.x / (white.x + white.y + white.z), 0.3127, 6e-5);
    EXPECT_NEAR(white.y / (white.x + white.y + white.z), 0.3290, 6e-5);
}

/// The basis is fitted to sRGB at 8 bits; it is within 8.3e-4 of the matrix, a fifth of an 8-bit step (measured).
TEST(LightSpectra, RgbToXyzIsTheRec709Matrix) {
    const LightSpectra spectra;
    for (int c = 0; c < 3; ++c) {
        glm::dvec3 rgb(0.0);
        rgb[c] = 1.0;
        const glm::dvec3 difference = rgb_to_xyz(spectra, rgb) - rec709_to_xyz() * rgb;
        EXPECT_LT(glm::length(difference), 9e-4) << "channel " << c;
    }
}

TEST(LightSpectra, AreRelativeToTheIlluminantsOwnWhite) {
    const LightSpectra spectra{illuminant("A")};
    const glm::dvec3 white = rgb_to_xyz(spectra, glm::dvec3(1.0));
    EXPECT_NEAR(white.y, 1.0, 1e-5);
    EXPECT_NEAR(white.x / (white.x + white.y + white.z), 0.4476, 1e-3);
}

/// The message of what `read` refuses in this text.
std::string refusal(const std::string& text, const std::function<void(JsonReader&)>& read) {
    const nlohmann::json json = parse_json(text, "m.json");
    JsonReader reader(json, "m.json");
    return test::message_of([&] { read(reader); });
}

TEST(ColourJson, ReadsEveryMetal) {
    for (const Metal metal : {Metal::Al, Metal::Ag, Metal::Au, Metal::Cu}) {
        const nlohmann::json json = {{"metal", metal_name(metal)}};
        JsonReader reader(json, "m.json");
        EXPECT_EQ(read_metal(reader), metal);
        EXPECT_NO_THROW(reader.finish());
    }
}

TEST(ColourJson, UnknownMetalsListTheKnownOnes) {
    EXPECT_THAT(refusal(R"({"metal": "Fe"})", read_metal),
                AllOf(HasSubstr("m.json: /metal"), HasSubstr("\"Fe\""), HasSubstr("one of Al, Ag, Au, Cu")));
    EXPECT_THAT(refusal(R"({"metal": 3})", read_metal), HasSubstr("/metal"));
    EXPECT_THAT(refusal("{}", read_metal), HasSubstr("/metal: missing"));
}

TEST(ColourJson, ReadsEveryBuiltInIlluminant) {
    for (const std::string& name : illuminant_names()) {
        const nlohmann::json json = {{"illuminant", name}};
        JsonReader reader(json, "m.json");
        EXPECT_EQ(read_builtin_illuminant(reader).name, name);
        EXPECT_EQ(std::get<Illuminant>(read_illuminant(reader, "the material")).name, name);
        EXPECT_NO_THROW(reader.finish());
    }
}

TEST(ColourJson, IlluminantIsD65WithoutTheKey) {
    const nlohmann::json json = nlohmann::json::object();
    JsonReader reader(json, "m.json");
    EXPECT_EQ(read_builtin_illuminant(reader).name, "D65");
    EXPECT_EQ(std::get<Illuminant>(read_illuminant(reader, "the material")).name, "D65");
}

TEST(ColourJson, IlluminantMayBeAFilesName) {
    const nlohmann::json json = {{"illuminant", "lamps/sodium.csv"}};
    JsonReader reader(json, "m.json");
    EXPECT_EQ(std::get<std::string>(read_illuminant(reader, "the material")), "lamps/sodium.csv");
}

TEST(ColourJson, UnknownIlluminantsListTheKnownOnes) {
    const auto from_file = [](JsonReader& reader) { read_illuminant(reader, "the recipe"); };
    EXPECT_THAT(refusal(R"({"illuminant": "F12"})", from_file),
                AllOf(HasSubstr("m.json: /illuminant"), HasSubstr("\"F12\""), HasSubstr("one of A, D65, E, F11"),
                      HasSubstr(".csv file beside the recipe"), HasSubstr("meant?")));
    EXPECT_THAT(refusal(R"({"illuminant": 5})", from_file), HasSubstr("/illuminant"));
    EXPECT_THAT(
        refusal(R"({"illuminant": "lamp.csv"})", read_builtin_illuminant),
        AllOf(HasSubstr("m.json: /illuminant"), HasSubstr("one of A, D65, E, F11"), Not(HasSubstr(".csv file"))));
}

}  // namespace

}  // namespace rowland::colour
