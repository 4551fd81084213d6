#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "engine/core/file.h"
#include "tests/support/csv.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/editor/trade/trade_run.h"

namespace rowland {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A film and light of radiance 1 from everywhere, RGBE (128, 128, 128, 129).
class FilmsProgram : public ::testing::Test {
 protected:
    FilmsProgram() {
        std::string light = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 64\n";
        for (int i = 0; i < 32 * 64; ++i) light += "\x80\x80\x80\x81";
        write("even.hdr", light);
        write("frames.csv",
              "vx,vy,vz,nx,ny,nz,gx,gy,gz\n0,2,0,0,1,0,1,0,0\n0.6,0.8,0,0,1,0,1,0,0\n0,-1,0,0,1,0,1,0,0\n");
    }
    void write(const std::string& name, const std::string& text) { write_file_atomic(folder_.path() / name, text); }
    void write_film(const std::string& roughness) {
        write("film.json",
              R"({"film": {"ior": 1.3, "thickness_nm": 250}, "metal": "Ag", "roughness": )" + roughness + "}");
    }
    test::Csv evaluated(const std::string& method) {
        const test::TradeRun run = test::run_trade(
            folder_.path(), "evaluate --material film.json --probe even.hdr --frames frames.csv --method " + method);
        EXPECT_EQ(run.exit_code, 0) << run.messages;
        write("results.csv", run.output);
        return test::read_csv(folder_.path() / "results.csv");
    }

    test::TemporaryFolder folder_;
};

TEST_F(FilmsProgram, WritesAPictureAndHowFarOffTheFormulasAre) {
    const test::TradeRun run = test::run_trade(folder_.path(), "films swatches.png");
    EXPECT_EQ(run.exit_code, 0) << run.messages;
    EXPECT_THAT(run.output, AllOf(HasSubstr("| soap (1.33 on air) | 33.2 % | 24.2 % |"), HasSubstr("titanium")));
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "swatches.png"));
}

TEST_F(FilmsProgram, EvaluateGivesTheReferenceAndTheTableOfAFilm) {
    for (const char* roughness : {"0", "0.4"}) {
        write_film(roughness);
        const test::Csv reference = evaluated("reference");
        const test::Csv table = evaluated("table");
        ASSERT_EQ(reference.rows.size(), 3U);
        for (std::size_t row = 0; row < 2; ++row) {
            EXPECT_GT(reference.number(row, "Y"), 0.6) << "silver";
            for (const char* axis : {"X", "Y", "Z"})
                EXPECT_NEAR(table.number(row, axis), reference.number(row, axis), 5e-3) << roughness << " " << row;
        }
        EXPECT_EQ(reference.number(2, "Y"), 0.0) << "seen from behind";
    }
}

TEST_F(FilmsProgram, EvaluateRefusesAGratingsMethodForAFilm) {
    write_film("0");
    const test::TradeRun run = test::run_trade(
        folder_.path(), "evaluate --material film.json --probe even.hdr --frames frames.csv --method spikes");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.messages, AllOf(HasSubstr("spikes"), HasSubstr("reference or table")));
}

}  // namespace
}  // namespace rowland
