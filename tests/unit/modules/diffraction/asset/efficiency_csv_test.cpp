#include "modules/diffraction/asset/material.h"

#include <gmock/gmock.h>

#include "engine/core/file.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

EfficiencyTable parse_table(const std::string& text) {
    return parse_efficiency_csv(text, "t.csv");
}

std::string table_refusal(const std::string& text) {
    return rowland::test::message_of([&] { parse_table(text); });
}

TEST(EfficiencyCsv, ColumnsAreSortedByOrder) {
    const EfficiencyTable table = parse_table("wavelength_nm, R+2,R-1,R+0\r\n400,0.2,0.1,0.5\n\n700,0.3,0.05,0.4\n");
    EXPECT_THAT(table.orders, ElementsAre(-1, 0, 2));
    ASSERT_EQ(table.slices.size(), 1U);
    EXPECT_EQ(table.slices[0].incidence_deg, 0.0);
    EXPECT_THAT(table.slices[0].wavelengths_nm, ElementsAre(400.0, 700.0));
    EXPECT_THAT(table.slices[0].efficiencies, ElementsAre(0.1, 0.5, 0.2, 0.05, 0.4, 0.3));
}

TEST(EfficiencyCsv, IncidencesAreSlicesInAscendingOrder) {
    const EfficiencyTable table =
        parse_table("wavelength_nm,incidence_deg,R+1\n400,30,0.1\n400,-10,0.2\n500,30,0.3\n500,-10,0.4\n");
    ASSERT_EQ(table.slices.size(), 2U);
    EXPECT_EQ(table.slices[0].incidence_deg, -10.0);
    EXPECT_THAT(table.slices[0].efficiencies, ElementsAre(0.2, 0.4));
    EXPECT_EQ(table.slices[1].incidence_deg, 30.0);
    EXPECT_THAT(table.slices[1].efficiencies, ElementsAre(0.1, 0.3));
}

TEST(EfficiencyCsv, WritesWhatItReads) {
    const EfficiencyTable table =
        parse_table("wavelength_nm,incidence_deg,R-1,R+0\n400.25,0,0.1,0.123456789012345\n500,7.5,0.3,0.25\n");
    const EfficiencyTable again = parse_table(write_efficiency_csv(table));
    EXPECT_EQ(again.orders, table.orders);
    ASSERT_EQ(again.slices.size(), table.slices.size());
    for (std::size_t i = 0; i < again.slices.size(); ++i) {
        EXPECT_EQ(again.slices[i].incidence_deg, table.slices[i].incidence_deg);
        EXPECT_EQ(again.slices[i].wavelengths_nm, table.slices[i].wavelengths_nm);
        EXPECT_EQ(again.slices[i].efficiencies, table.slices[i].efficiencies);
    }
}

TEST(EfficiencyCsv, BadHeadersAreRefused) {
    EXPECT_THAT(table_refusal(""), AllOf(HasSubstr("t.csv"), HasSubstr("empty")));
    EXPECT_THAT(table_refusal("lambda,R+0\n500,1\n"), AllOf(HasSubstr("\"lambda\""), HasSubstr("wavelength_nm")));
    for (const char* name : {"R1", "R", "R+", "R+x", "R+-1", "R+1.5", "r+1", "R+10001", "", "T+1"})
        EXPECT_THAT(table_refusal(std::string("wavelength_nm,R+0,") + name + "\n500,1,0\n"),
                    AllOf(HasSubstr("header"), HasSubstr("\"" + std::string(name) + "\"")));
    EXPECT_THAT(table_refusal("wavelength_nm,R+1,R+1\n500,0.1,0.1\n"), HasSubstr("order 1 twice"));
    EXPECT_THAT(table_refusal("wavelength_nm,R-0,R+0\n500,0.1,0.1\n"), HasSubstr("order 0 twice"));
    EXPECT_THAT(table_refusal("wavelength_nm\n500\n"), HasSubstr("no order"));
    EXPECT_THAT(table_refusal("wavelength_nm,incidence_deg\n500,0\n"), HasSubstr("no order"));
}

TEST(EfficiencyCsv, BadRowsAreRefusedByNumber) {
    const std::string header = "wavelength_nm,R-1,R+1\n";
    EXPECT_THAT(table_refusal(header), HasSubstr("no rows"));
    EXPECT_THAT(table_refusal(header + "400,0.1,0.2\n500,0.5,0.6\n"),
                AllOf(HasSubstr("t.csv: row 3"), HasSubstr("sum to 1.1")));
    EXPECT_THAT(table_refusal(header + "400,0.1,-0.2\n"), AllOf(HasSubstr("row 2"), HasSubstr("-0.2 for order 1")));
    EXPECT_THAT(table_refusal(header + "400,0.1,0.2\n400,0.1,0.2\n"),
                AllOf(HasSubstr("row 3"), HasSubstr("ascending")));
    EXPECT_THAT(table_refusal(header + "400,0.1,0.2\n390,0.1,0.2\n"),
                AllOf(HasSubstr("row 3"), HasSubstr("ascending")));
    EXPECT_THAT(table_refusal(header + "400,0.1\n"), AllOf(HasSubstr("row 2"), HasSubstr("2 fields")));
    EXPECT_THAT(table_refusal(header + "400,0.1,nan\n"), AllOf(HasSubstr("row 2"), HasSubstr("nan")));
    EXPECT_THAT(table_refusal(header + "400,0.1,inf\n"), HasSubstr("row 2"));
    EXPECT_THAT(table_refusal(header + "0,0.1,0.2\n"), AllOf(HasSubstr("row 2"), HasSubstr("above 0 nm")));
    EXPECT_THAT(table_refusal(header + "0.4,0.1,0.2\n0.7,0.1,0.2\n"), HasSubstr("micrometres"));
    EXPECT_THAT(table_refusal("wavelength_nm,incidence_deg,R+1\n400,90,0.1\n"),
                AllOf(HasSubstr("row 2"), HasSubstr("incidence_deg 90")));
}

TEST(EfficiencyCsv, RoundingMayTakeARowAThousandthAboveOne) {
    EXPECT_NO_THROW(parse_table("wavelength_nm,R-1,R+1\n400,0.5,0.50099\n"));
    EXPECT_THAT(table_refusal("wavelength_nm,R-1,R+1\n400,0.5,0.5011\n"), HasSubstr("1.0011"));
}

/// Every rigorous table is read, and no wavelength, however fine, gets more than it is sent.
TEST(EfficiencyCsv, RigorousTablesNeverSumToMoreThanOne) {
    ROWLAND_TEST_DATA(folder, "data/efficiency");
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const EfficiencyTable table = parse_efficiency_csv(read_text_file(entry.path(), 1 << 20), name);
        const double pitch_nm = std::stod(name.substr(name.find("_p") + 2));
        for (double wavelength_nm = 380.0; wavelength_nm <= 780.0; wavelength_nm += 0.5) {
            double sum = 0.0;
            for (const int order : table.orders) sum += table_efficiency(table, pitch_nm, order, wavelength_nm, 0.0);
            EXPECT_LE(sum, 1.0 + 1e-12) << name << " " << wavelength_nm;
            EXPECT_GT(sum, 0.5) << name << " " << wavelength_nm;
        }
        ++files;
    }
    EXPECT_GE(files, 4);
}

}  // namespace
}  // namespace rowland::diffraction
