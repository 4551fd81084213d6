#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "engine/core/file.h"
#include "tests/support/environment.h"
#include "tests/support/files.h"
#include "tests/unit/editor/trade/trade_run.h"

namespace rowland {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class TradeSweep : public ::testing::Test {
 protected:
    void SetUp() override { test::write_sweep_inputs(folder_.path()); }

    test::Ended run(const std::string& arguments) { return test::run_trade(folder_.path(), arguments); }
    std::string file(const std::string& name) const { return read_text_file(folder_.path() / name, 1 << 24); }
    std::size_t lines(const std::string& name) const {
        if (!std::filesystem::exists(folder_.path() / name)) return 0;
        const std::string text = file(name);
        return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    }

    test::TemporaryFolder folder_;
};

TEST_F(TradeSweep, HasARowForEverySettingAndSetInBothTables) {
    const auto done = run("sweep --no-times " + test::small_sweep());
    ASSERT_EQ(done.code, 0) << done.err;
    EXPECT_THAT(done.out, HasSubstr(std::filesystem::path("results/sweep.csv").make_preferred().string()));
    const auto rows = test::read_rows(folder_.path() / "results" / "sweep.csv");
    ASSERT_EQ(rows.size(), 3U * 3U - 1U);  // settings × (tilted_cd, sphere, picture); no map is of a sphere
    std::istringstream json_lines(file("results/sweep.jsonl"));
    std::string line;
    for (const test::Row& row : rows) {
        ASSERT_TRUE(std::getline(json_lines, line));
        const auto json = nlohmann::json::parse(line);
        EXPECT_EQ(json["setting"], row.at("setting"));
        EXPECT_EQ(json["relative_rms"], std::stod(row.at("relative_rms")));
        EXPECT_EQ(row.at("frame_ms"), "") << "no times were asked for";
        EXPECT_EQ(row.at("hdr_flip").empty(), row.at("set") != "picture") << "only pictures have neighbours";
        EXPECT_GT(std::stoull(row.at("table_bytes")), 0U);
        // A map is exact on its plane but for its resolution; three bands lose the sun.
        EXPECT_FALSE(row.at("set") == "sphere" && row.at("representation") == "planar");
        if (row.at("set") != "tilted_cd") continue;
        const double error = std::stod(row.at("relative_rms"));
        if (row.at("representation") == "planar") {
            EXPECT_LT(error, 0.05);
        }
        if (row.at("representation") == "spikes") {
            EXPECT_GT(error, 0.1);
        }
    }
}

TEST_F(TradeSweep, ItsErrorsAreEvaluatesOwn) {
    write_file_atomic(folder_.path() / "frames.csv",
                      "vx,vy,vz,nx,ny,nz,gx,gy,gz\n0.3,0.9,0.2,0,1,0,1,0,0\n0.1,0.7,-0.4,0,1,0,0.6,0,0.8\n"
                      "-0.5,0.6,0.1,0,1,0,0.9,0,-0.2\n");
    ASSERT_EQ(run("sweep --no-times --frames mine=frames.csv " + test::small_sweep()).code, 0);
    const std::string common = "evaluate --material cd.json --probe sky.hdr --frames frames.csv --method ";
    const auto values = [&](const std::string& method) {
        write_file_atomic(folder_.path() / "out.csv", run(common + method).out);
        std::vector<double> result;
        for (const test::Row& row : test::read_rows(folder_.path() / "out.csv"))
            for (const char* component : {"X", "Y", "Z"}) result.push_back(std::stod(row.at(component)));
        return result;
    };
    const std::vector<double> reference = values("reference");
    const std::vector<double> arc = values("arc --bands 4 --rank 8 --storage fp16");
    double difference = 0.0;
    double scale = 0.0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        difference += std::pow(arc[i] - reference[i], 2);
        scale += std::pow(reference[i], 2);
    }
    int compared = 0;
    for (const test::Row& row : test::read_rows(folder_.path() / "results" / "sweep.csv"))
        if (row.at("set") == "mine" && row.at("representation") == "arc") {
            // evaluate prints nine digits
            EXPECT_NEAR(std::stod(row.at("relative_rms")), std::sqrt(difference / scale), 1e-7);
            ++compared;
        }
    EXPECT_EQ(compared, 1);
}

TEST_F(TradeSweep, ASecondRunMeasuresNothingAndWritesTheSame) {
    ASSERT_EQ(run("sweep --no-times " + test::small_sweep()).code, 0);
    const std::string csv = file("results/sweep.csv");
    const std::string journal = file("results/journal.jsonl");
    ASSERT_EQ(run("sweep --no-times " + test::small_sweep()).code, 0);
    EXPECT_EQ(file("results/journal.jsonl"), journal);
    EXPECT_EQ(file("results/sweep.csv"), csv);
}

TEST_F(TradeSweep, TablesHoldNamesOfAnyBytes) {
    if (!test::has_posix_files()) GTEST_SKIP() << "names of files are Unicode here";
    std::filesystem::rename(folder_.path() / "cd.json", folder_.path() / "b\xff, \"c\".json");
    ASSERT_EQ(run("sweep --no-times --material 'b\xff, \"c\".json' --probe sky.hdr --setting arc/bands=2/rank=2 "
                  "--picture-size 8 8 --output results")
                  .code,
              0);
    EXPECT_THAT(file("results/sweep.csv"), HasSubstr("\n\"b\xef\xbf\xbd, \"\"c\"\"\",sky,"));
    const std::string lines = file("results/sweep.jsonl");
    EXPECT_EQ(nlohmann::json::parse(lines.substr(0, lines.find('\n')))["material"], "b\xef\xbf\xbd, \"c\"");
}

TEST_F(TradeSweep, AnotherProbeOrMaterialIsMeasuredAnew) {
    ASSERT_EQ(run("sweep --no-times " + test::small_sweep()).code, 0);
    const std::size_t before = lines("results/journal.jsonl");
    const auto first = test::read_rows(folder_.path() / "results" / "sweep.csv");
    std::string probe = file("sky.hdr");
    probe[probe.size() - 3] = '\x60';
    write_file_atomic(folder_.path() / "sky.hdr", probe);
    ASSERT_EQ(run("sweep --no-times " + test::small_sweep()).code, 0);
    EXPECT_EQ(lines("results/journal.jsonl"), 2 * before);
    EXPECT_NE(test::read_rows(folder_.path() / "results" / "sweep.csv")[0].at("relative_rms"),
              first[0].at("relative_rms"));
    write_file_atomic(folder_.path() / "cd.json",
                      R"({"grating": {"pitch_nm": 1500, "profile": {"type": "slit", "width_nm": 800}}})");
    ASSERT_EQ(run("sweep --no-times " + test::small_sweep()).code, 0);
    EXPECT_EQ(lines("results/journal.jsonl"), 3 * before);
}

/// Killed while it measures, whatever it has measured stays and is not measured again.
TEST_F(TradeSweep, KilledItGoesOnWhereItStopped) {
    const std::string arguments =
        "sweep --no-times --setting circle/map_resolution=32 --setting arc/bands=8 " + test::small_sweep();
    constexpr std::size_t kEnough = 4;
    {
        const test::Running sweep(test::command(ROWLAND_TRADE, arguments),
                                  {.folder = folder_.path(), .limit = std::chrono::minutes(5)});
        while (lines("results/journal.jsonl") < kEnough && sweep.alive())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const std::string left = file("results/journal.jsonl");
    const std::string whole = left.substr(0, left.rfind('\n') + 1);
    ASSERT_GE(std::count(whole.begin(), whole.end(), '\n'), static_cast<std::ptrdiff_t>(kEnough));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "results" / "sweep.csv")) << "killed too late to tell";

    ASSERT_EQ(run(arguments).code, 0);
    const std::string journal = file("results/journal.jsonl");
    EXPECT_EQ(journal.substr(0, whole.size()), whole) << "nothing is lost or measured again";
    EXPECT_EQ(lines("results/journal.jsonl"), 5U * 3U - 1U);
    std::set<std::string> keys;
    std::istringstream entries(journal);
    for (std::string line; std::getline(entries, line);) keys.insert(nlohmann::json::parse(line)["key"]);
    EXPECT_EQ(keys.size(), 5U * 3U - 1U);
}

TEST_F(TradeSweep, FramesAreTimedAgainstThePlainMaterial) {
    ASSERT_EQ(run("sweep --frame-size 64 36 " + test::small_sweep()).code, 0);
    for (const test::Row& row : test::read_rows(folder_.path() / "results" / "sweep.csv")) {
        EXPECT_GT(std::stod(row.at("frame_ms")), 0.0);
        EXPECT_NEAR(std::stod(row.at("frame_ratio")), std::stod(row.at("frame_ms")) / std::stod(row.at("plain_ms")),
                    1e-6);
        EXPECT_GE(std::stod(row.at("frame_spread")), 0.0);
    }
}

TEST_F(TradeSweep, CompareSaysHowFarAMethodIsFromTheReference) {
    const std::string common = "compare --material cd.json --probe sky.hdr --size 24 14 --method ";
    const auto arc = run(common + "arc/bands=4/rank=8 --difference d.png");
    ASSERT_EQ(arc.code, 0) << arc.err;
    write_file_atomic(folder_.path() / "arc.csv", arc.out);
    const auto rows = test::read_rows(folder_.path() / "arc.csv");
    ASSERT_EQ(rows.size(), 6U);
    EXPECT_EQ(rows[0].at("quantity"), "relative_rms");
    EXPECT_GT(std::stod(rows[0].at("value")), 0.01);
    EXPECT_GE(std::stod(rows[4].at("value")), std::stod(rows[3].at("value"))) << "95 % and median";
    EXPECT_EQ(rows[5].at("quantity"), "hdr_flip");
    EXPECT_GT(std::stod(rows[5].at("value")), 1e-3);
    EXPECT_LT(std::stod(rows[5].at("value")), 0.5);
    EXPECT_THAT(file("d.png"), HasSubstr("PNG"));
    const auto same = run(common + "reference");
    EXPECT_THAT(same.out, AllOf(HasSubstr("relative_rms,0\n"), HasSubstr("hdr_flip,0\n")));
    // The two ways round have one difference and two scales.
    EXPECT_EQ(run(common + "arc/bands=4/rank=8 --against arc/bands=4/rank=8").out, same.out);
}

TEST_F(TradeSweep, WrongUsageExitsWith2AndSaysWhy) {
    const auto refusal = [&](const std::string& arguments) {
        const auto outcome = run(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        return outcome.err;
    };
    const std::string common = "sweep --no-times --material cd.json --output r --probe ";
    EXPECT_THAT(refusal(common + "none.hdr"), HasSubstr("none.hdr"));
    EXPECT_THAT(refusal(common + "sky.hdr --frames frames.csv"), HasSubstr("NAME=FILE"));
    EXPECT_THAT(refusal(common + "sky.hdr --frames picture=sky.hdr"), Not(HasSubstr("terminate")));
    EXPECT_THAT(refusal("sweep --no-times --material cd.json --output unused --probe sky.hdr --setting arc/rang=3"),
                HasSubstr("rank"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "unused")) << "settings are checked before work";
    EXPECT_THAT(refusal(common + "sky.hdr:angular"), HasSubstr("square"));
    EXPECT_THAT(refusal("sweep --material cd.json --probe sky.hdr"), HasSubstr("--output"));
    // Refused before the reference is computed, which would take minutes.
    for (const char* option : {"--method", "--method arc --against"})
        EXPECT_THAT(refusal(fmt::format("compare --material cd.json --probe sky.hdr --size 1024 1024 {} arcs", option)),
                    HasSubstr("arc"));
    EXPECT_THAT(refusal("compare --material cd.json --probe sky.hdr --method arc --frames f --difference d.png"),
                HasSubstr("--difference"));
}

TEST_F(TradeSweep, NoOutputIsAnInputOrADevice) {
    const std::string cd = file("cd.json");
    const auto refusal = [&](const std::string& arguments) {
        const auto outcome = run(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_EQ(file("cd.json"), cd) << arguments;
        return outcome.err;
    };
    const std::string common = " --material cd.json --probe sky.hdr ";
    if (test::has_posix_files()) {
        EXPECT_THAT(refusal("sweep --output /dev/full" + common), HasSubstr("/dev/full"));
        EXPECT_THAT(refusal("compare --method arc --difference /dev/full" + common), HasSubstr("--difference"));
    }
    EXPECT_THAT(refusal("sweep --output cd.json" + common), HasSubstr("cd.json"));
    EXPECT_THAT(refusal("compare --method arc --difference d.jpg" + common), HasSubstr(".png"));
    std::filesystem::create_hard_link(folder_.path() / "cd.json", folder_.path() / "d.png");
    EXPECT_THAT(refusal("compare --method arc --difference d.png" + common), HasSubstr("an input"));
    std::filesystem::create_directory(folder_.path() / "results");
    for (const char* name : {"journal.jsonl", "references.jsonl", "sweep.csv", "sweep.jsonl", "report.html"}) {
        const auto link = folder_.path() / "results" / name;
        if (!test::make_link(folder_.path() / "cd.json", link)) break;
        EXPECT_THAT(refusal("report --output results" + common), HasSubstr("an input")) << name;
        std::filesystem::remove(link);
    }
    // A file that the material names is an input as well.
    write_file_atomic(folder_.path() / "table.json",
                      R"({"grating": {"pitch_nm": 1600, "profile": {"type": "table", "file": "results/sweep.csv"}}})");
    write_file_atomic(folder_.path() / "results" / "sweep.csv",
                      "wavelength_nm,R-1,R+0,R+1\n380,.1,.1,.1\n780,.1,.1,.1\n");
    EXPECT_THAT(refusal("sweep --output results --material table.json --probe sky.hdr"), HasSubstr("an input"));
}

TEST_F(TradeSweep, NumbersThatAreNoSizesAreRefused) {
    for (const char* number : {"nan", "inf", "-inf", "0", "-1", "1e300", "8.5", ""})
        for (const std::string option : {"--picture-size", "--frame-size", "--size", "--magnified", "--bands"}) {
            const std::string command = option == "--bands" ? "project --probe sky.hdr"
                                        : option.ends_with("e-size")
                                            ? "sweep --output r --material cd.json --probe sky.hdr"
                                            : "compare --method arc --material cd.json --probe sky.hdr";
            const std::string values =
                option.ends_with("size") ? fmt::format("'{0}' '{0}'", number) : fmt::format("'{}'", number);
            const auto refused = run(fmt::format("{} {} {}", command, option, values));
            EXPECT_EQ(refused.code, 2) << command << option << number;
            if (*number != '-') {
                EXPECT_THAT(refused.err, HasSubstr(option)) << number;
            }
        }
}

}  // namespace
}  // namespace rowland
