#include <gmock/gmock.h>

#include <complex>
#include <tuple>

#include "engine/colour/spectrum.h"
#include "engine/core/error.h"
#include "tests/support/expect.h"

namespace rowland::colour {

namespace {

using ::testing::HasSubstr;

TEST(SampledSpectrum, IsLinearBetweenSamplesAndExactAtThem) {
    for (const std::vector<double>& wavelengths :
         {std::vector<double>{400, 410, 420}, std::vector<double>{400, 410, 440}}) {
        const SampledSpectrum spectrum(wavelengths, {1.0, 3.0, 2.0}, Outside::Zero);
        EXPECT_EQ(spectrum(400.0), 1.0);
        EXPECT_EQ(spectrum(410.0), 3.0);
        EXPECT_EQ(spectrum(wavelengths[2]), 2.0);
        EXPECT_DOUBLE_EQ(spectrum(402.5), 1.5);
        EXPECT_DOUBLE_EQ(spectrum(0.5 * (wavelengths[1] + wavelengths[2])), 2.5);
    }
}

TEST(SampledSpectrum, IsZeroOrClampedOutside) {
    const SampledSpectrum zero({400, 410}, {1.0, 3.0}, Outside::Zero);
    const SampledSpectrum clamped({400, 410}, {1.0, 3.0}, Outside::Clamp);
    EXPECT_EQ(zero(399.999), 0.0);
    EXPECT_EQ(zero(410.001), 0.0);
    EXPECT_EQ(clamped(399.999), 1.0);
    EXPECT_EQ(clamped(410.001), 3.0);
}

constexpr const char* kHeader = "wavelength_nm,relative_power";

std::string refusal(const std::string& text) {
    return test::message_of([&] { parse_spectrum_csv(text, "lamp.csv", kHeader); });
}

TEST(SpectrumCsv, ReadsRowsWhateverTheLineEndsAndBlankLines) {
    const SpectrumTable table = parse_spectrum_csv(
        "\xEF\xBB\xBFwavelength_nm, relative_power\r\n400, 1.5\r\n\r\n410,2e-1", "lamp.csv", kHeader);
    EXPECT_EQ(table.wavelengths_nm, (std::vector<double>{400.0, 410.0}));
    ASSERT_EQ(table.columns.size(), 1U);
    EXPECT_EQ(table.columns[0], (std::vector<double>{1.5, 0.2}));
}

TEST(SpectrumCsv, RefusesAndNamesFileAndRow) {
    EXPECT_THAT(refusal("nm,power\n400,1\n410,1\n"), HasSubstr("lamp.csv: row 1: \"nm,power\""));
    EXPECT_THAT(refusal("wavelength_nm,relative_power\n400,1\n410\n"), HasSubstr("row 3: 1 fields"));
    EXPECT_THAT(refusal("wavelength_nm,relative_power\n400,1\n410,abc\n"), HasSubstr("row 3: \"abc\""));
    EXPECT_THAT(refusal("wavelength_nm,relative_power\n400,1\n410,1x\n"), HasSubstr("row 3: \"1x\""));
    EXPECT_THAT(refusal("wavelength_nm,relative_power\n400,nan\n410,1\n"), HasSubstr("row 2: \"nan\""));
    EXPECT_THAT(refusal("wavelength_nm,relative_power\n400,1\n400,1\n"), HasSubstr("row 3: wavelength 400"));
    EXPECT_THAT(refusal("wavelength_nm,relative_power\n-1,1\n400,1\n"), HasSubstr("row 2: wavelength -1"));
    EXPECT_THAT(refusal("wavelength_nm,relative_power\n400,1\n"), HasSubstr("1 rows of data"));
    EXPECT_THAT(refusal(""), HasSubstr("an empty file"));
}

TEST(SpectrumCsv, KeepsMessagesShortForHugeFields) {
    EXPECT_LT(refusal("wavelength_nm,relative_power\n400," + std::string(100000, 'x') + "\n").size(), 300U);
}

/// CIE 018:2019, 555 nm: x̄ = 0.5121, ȳ = 1.0000, z̄ = 0.0057 as printed.
TEST(Observer, HasThePublishedValuesAt555nm) {
    EXPECT_NEAR(cie_xyz(555.0).x, 0.5121, 5e-5);
    EXPECT_NEAR(cie_xyz(555.0).y, 1.0000, 5e-5);
    EXPECT_NEAR(cie_xyz(555.0).z, 0.0057, 1e-4);
}

/// The standard makes the three areas equal; the sums of its 1 nm table over 360–830 nm as CVRL prints them, to the
/// digit.
TEST(Observer, HasThePublishedSums) {
    glm::dvec3 sum(0.0);
    for (int wavelength_nm = 360; wavelength_nm <= 830; ++wavelength_nm) sum += cie_xyz(wavelength_nm);
    EXPECT_NEAR(sum.x, 106.8655, 1e-4);
    EXPECT_NEAR(sum.y, 106.8569, 1e-4);
    EXPECT_NEAR(sum.z, 106.8923, 1e-4);
}

TEST(Observer, SeesNothingOutsideItsTable) {
    EXPECT_EQ(cie_xyz(359.0), glm::dvec3(0.0));
    EXPECT_EQ(cie_xyz(831.0), glm::dvec3(0.0));
}

/// Handbook reflectances of evaporated films at normal incidence (CRC Handbook, "Optical properties of metals"), whose
/// samples differ from author to author by a few per cent.
TEST(Metal, ReflectsAsHandbooksSay) {
    EXPECT_NEAR(metal_reflectance(Metal::Al, 550.0), 0.915, 0.02);
    EXPECT_NEAR(metal_reflectance(Metal::Ag, 550.0), 0.96, 0.03);
    EXPECT_NEAR(metal_reflectance(Metal::Au, 450.0), 0.38, 0.04);
    EXPECT_NEAR(metal_reflectance(Metal::Au, 650.0), 0.95, 0.04);
    EXPECT_NEAR(metal_reflectance(Metal::Cu, 500.0), 0.55, 0.07);
    EXPECT_NEAR(metal_reflectance(Metal::Cu, 650.0), 0.94, 0.05);
}

/// Rows of the published tables, at their own wavelengths: nm, n, k.
TEST(Metal, IndicesAreThoseOfTheTables) {
    const std::vector<std::tuple<Metal, double, double, double>> rows = {
        {Metal::Ag, 551.040771, 0.124375, 3.348125}, {Metal::Ag, 309.960449, 1.323, 0.647},
        {Metal::Al, 302.400421, 0.28, 3.64},         {Metal::Au, 302.400421, 1.812, 1.92},
        {Metal::Cu, 302.400421, 1.38, 1.687},
    };
    for (const auto& [metal, nm, n, k] : rows) {
        EXPECT_EQ(metal_index(metal, nm), std::complex(n, k)) << metal_name(metal) << nm;
    }
}

TEST(Metal, ReflectanceIsAShareAtEveryWavelength) {
    for (const Metal metal : {Metal::Al, Metal::Ag, Metal::Au, Metal::Cu})
        for (int wavelength_nm = 200; wavelength_nm <= 1000; ++wavelength_nm) {
            EXPECT_GT(metal_reflectance(metal, wavelength_nm), 0.0);
            EXPECT_LT(metal_reflectance(metal, wavelength_nm), 1.0);
        }
}

TEST(Metal, NamesRoundTrip) {
    for (const Metal metal : {Metal::Al, Metal::Ag, Metal::Au, Metal::Cu})
        EXPECT_EQ(parse_metal(metal_name(metal)), metal);
    EXPECT_FALSE(parse_metal("al"));
    EXPECT_FALSE(parse_metal("Fe"));
}

}  // namespace

}  // namespace rowland::colour
