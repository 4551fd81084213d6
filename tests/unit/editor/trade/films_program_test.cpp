#include <gmock/gmock.h>

#include "engine/core/file.h"
#include "tests/support/csv.h"
#include "tests/support/folder_test.h"
#include "tests/unit/editor/trade/trade_run.h"

namespace rowland {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A film and light of radiance 1 from everywhere.
class FilmsProgram : public test::FolderTest {
 protected:
    FilmsProgram() {
        write("even.hdr", test::uniform_hdr(64, 32));
        write("frames.csv",
              "vx,vy,vz,nx,ny,nz,gx,gy,gz\n0,2,0,0,1,0,1,0,0\n0.6,0.8,0,0,1,0,1,0,0\n0,-1,0,0,1,0,1,0,0\n");
    }
    void write_film(const std::string& roughness) {
        write("film.json",
              R"({"film": {"ior": 1.3, "thickness_nm": 250}, "metal": "Ag", "roughness": )" + roughness + "}");
    }
    test::Csv evaluated(const std::string& method) {
        const test::Ended run = test::run_trade(
            folder_.path(), "evaluate --material film.json --probe even.hdr --frames frames.csv --method " + method);
        EXPECT_EQ(run.code, 0) << run.err;
        write("results.csv", run.out);
        return test::read_csv(path("results.csv"));
    }
};

TEST_F(FilmsProgram, WritesAPictureAndHowFarOffTheFormulasAre) {
    const test::Ended run = test::run_trade(folder_.path(), "films swatches.png");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(run.out, AllOf(HasSubstr("| soap (1.33 on air) | 33.2 % | 24.2 % |"), HasSubstr("titanium")));
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "swatches.png"));
    EXPECT_EQ(test::run_trade(folder_.path(), "films swatches.jpg").code, 2);
}

TEST_F(FilmsProgram, PutsTheMethodsInTheirOrderUnderAProbe) {
    const test::Ended run = test::run_trade(folder_.path(), "films swatches.png --probe even.hdr");
    EXPECT_EQ(run.code, 0) << run.err;
    // Light from everywhere: the mean over the lobe is exact, and so are three bands. The formulas are as far off as on
    // smooth films.
    const auto error = [&](const std::string& method) {
        const std::string row = "| soap (1.33 on air) | 0.2 | " + method + " | ";
        const std::size_t at = run.out.find(row);
        return at == std::string::npos ? -1.0 : std::stod(run.out.substr(at + row.size()));
    };
    for (const char* method : {"table", "drawn", "drawn, rough reflections", "spherical harmonics, 3 bands"}) {
        EXPECT_GE(error(method), 0.0) << run.out;
        EXPECT_LE(error(method), 1.0) << method;
    }
    EXPECT_GT(error("glTF's formula"), 5.0);
    EXPECT_GT(error("three wavelengths"), 2.0);
}

TEST_F(FilmsProgram, EvaluateGivesTheReferenceAndTheMethodsOfAFilm) {
    for (const char* roughness : {"0", "0.4"}) {
        write_film(roughness);
        const test::Csv reference = evaluated("reference");
        const test::Csv table = evaluated("table");
        const test::Csv drawn = evaluated("drawn");
        const test::Csv rough = evaluated("drawn/rough-reflections");
        ASSERT_EQ(reference.rows.size(), 3U);
        for (std::size_t row = 0; row < 2; ++row) {
            EXPECT_GT(reference.number(row, "Y"), 0.6) << "silver";
            for (const char* axis : {"X", "Y", "Z"})
                for (const test::Csv* method : {&table, &drawn, &rough})
                    EXPECT_NEAR(method->number(row, axis), reference.number(row, axis), 5e-3)
                        << roughness << " " << row;
        }
        EXPECT_EQ(reference.number(2, "Y"), 0.0) << "seen from behind";
    }
}

TEST_F(FilmsProgram, EvaluateRefusesAGratingsMethodForAFilm) {
    write_film("0");
    const test::Ended run = test::run_trade(
        folder_.path(), "evaluate --material film.json --probe even.hdr --frames frames.csv --method spikes");
    EXPECT_EQ(run.code, 2);
    EXPECT_THAT(run.err, AllOf(HasSubstr("spikes"), HasSubstr("reference, table, drawn or drawn/rough-reflections")));
}

}  // namespace
}  // namespace rowland
