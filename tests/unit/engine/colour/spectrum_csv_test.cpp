#include "engine/colour/spectrum_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"

namespace rowland::colour {
namespace {

using ::testing::HasSubstr;

constexpr const char* kHeader = "wavelength_nm,relative_power";

std::string refusal(const std::string& text) {
    try {
        parse_spectrum_csv(text, "lamp.csv", kHeader);
    } catch (const Error& error) {
        EXPECT_EQ(error.info().fault, Fault::Input);
        return error.what();
    }
    return "accepted";
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

}  // namespace
}  // namespace rowland::colour
