// A sweep of hours when things go wrong around it: what it has measured is not lost.
#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>

#include "engine/core/file.h"
#include "tests/faults/moments.h"
#include "tests/faults/small_disk.h"
#include "tests/support/folder_test.h"
#include "tests/unit/editor/trade/trade_run.h"

namespace rowland {
namespace {

using test::Ended;
using test::Moment;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class SweepFaults : public test::FolderTest {
 protected:
    void SetUp() override { test::write_sweep_inputs(folder_.path()); }

    static std::string text(const std::filesystem::path& file) {
        return std::filesystem::exists(file) ? read_text_file(file, 1 << 24) : "";
    }
    test::Command sweep_to(const std::filesystem::path& results) const {
        return {ROWLAND_TRADE,
                "sweep",
                "--no-times",
                "--material",
                path("cd.json"),
                "--probe",
                path("sky.hdr"),
                "--setting",
                "arc/bands=4/rank=8",
                "--setting",
                "spikes/bands=3/spikes=2/view_resolution=8",
                "--picture-size",
                "16",
                "9",
                "--output",
                results};
    }
    /// The table that an undisturbed sweep writes.
    std::string undisturbed() const {
        const Ended ended = test::run(sweep_to(path("undisturbed")));
        EXPECT_EQ(ended.code, 0) << ended.err;
        return text(path("undisturbed/sweep.csv"));
    }
    static std::ptrdiff_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }
};

/// Killed, started again, killed …: each time after two more results.
TEST_F(SweepFaults, KilledAgainAndAgainItLosesNothingAndEndsWithTheSameTable) {
    const std::string table = undisturbed();
    const auto references = [&](const char* folder) { return text(path(folder) / "references.jsonl"); };
    const auto results = [&](const char* folder) { return text(path(folder) / "journal.jsonl"); };
    constexpr int kEach = 2;  // as many as its tables, which it writes last: so it comes to an end
    int kills = 0;
    for (bool killed = true; killed; ++kills) {
        ASSERT_LT(kills, 20) << "it begins again each time";
        killed = false;
        int writes = 0;
        const std::string known_references = references("results");
        const std::string known_results = results("results");
        const Ended ended =
            test::run_with_moments(sweep_to(path("results")), path("results"), [&](const Moment& moment) {
                killed = moment.call == "write" && ++writes > kEach;
                return !killed;
            });
        EXPECT_EQ(ended.code, killed ? 128 + SIGKILL : 0) << ended.err;
        EXPECT_THAT(references("results"), StartsWith(known_references));
        EXPECT_THAT(results("results"), StartsWith(known_results));
    }
    EXPECT_GT(kills, 3);
    EXPECT_EQ(references("results"), references("undisturbed")) << "measured twice";
    EXPECT_EQ(text(path("results/sweep.csv")), table);
}

TEST_F(SweepFaults, TwoAtOnceInOneFolderTheSecondIsRefusedAndTheFirstGoesOn) {
    const std::string table = undisturbed();
    int met = 0;
    const Ended ended = test::run_with_moments(sweep_to(path("results")), path("results"), [&](const Moment& moment) {
        if (moment.call != "write" || met > 0) return true;
        ++met;
        const Ended second = test::run(sweep_to(path("results")));
        EXPECT_EQ(second.code, 2) << second.err;
        EXPECT_THAT(second.err, AllOf(HasSubstr("results/references.jsonl"), HasSubstr("another process"),
                                      HasSubstr("name another folder")));
        return true;
    });
    EXPECT_EQ(met, 1);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(text(path("results/sweep.csv")), table);
}

TEST_F(SweepFaults, OnAFullDiskItStopsWithAClearLineAndGoesOnWhenThereIsRoom) {
    const test::SmallDisk disk(1024);
    ROWLAND_NEEDS_MOUNTED(disk);
    const std::string table = undisturbed();
    // The middle one of its references fits in part.
    disk.fill_but(std::filesystem::file_size(path("undisturbed/references.jsonl")) / 2 / 1024);
    const std::filesystem::path results = disk.path() / "results";
    const Ended full = test::run(sweep_to(results));
    EXPECT_EQ(full.code, 1);
    EXPECT_THAT(full.err, AllOf(HasSubstr(results.string()), HasSubstr(".jsonl: writing failed: No space left on device")));
    EXPECT_FALSE(std::filesystem::exists(results / "sweep.csv"));
    const std::string kept = text(results / "references.jsonl");
    const std::string whole_lines = kept.substr(0, kept.rfind('\n') + 1);
    EXPECT_GT(lines(whole_lines), 0);
    disk.free_again();
    EXPECT_EQ(test::run(sweep_to(results)).code, 0);
    EXPECT_THAT(text(results / "references.jsonl"), StartsWith(whole_lines)) << "measured again";
    EXPECT_EQ(text(results / "sweep.csv"), table);
}

TEST_F(SweepFaults, IntoAReadOnlyFolderItStopsBeforeItMeasures) {
    std::filesystem::create_directory(path("out"));
    std::filesystem::permissions(path("out"), std::filesystem::perms(0555));
    const Ended ended = test::run(sweep_to(path("out/results")), {.obey_modes = true});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, AllOf(HasSubstr(path("out/results").string()), HasSubstr("Permission denied")));
    EXPECT_TRUE(std::filesystem::is_empty(path("out")));
}

/// What is measured again depends on what the files hold, not on when they were written, nor on the clock.
TEST_F(SweepFaults, ClockSetBackMeasuresWhatChangedAndNothingElse) {
    const auto sweep = [&] {
        const Ended ended = test::run(sweep_to(path("results")), {.preload = ROWLAND_CLOCK_SET_BACK});
        EXPECT_EQ(ended.code, 0) << ended.err;
        return lines(text(path("results/journal.jsonl")));
    };
    const auto measured = sweep();
    EXPECT_EQ(text(path("results/sweep.csv")), undisturbed());
    const auto long_ago = std::filesystem::file_time_type::clock::now() - std::chrono::hours(24 * 365 * 40);
    std::filesystem::last_write_time(path("cd.json"), long_ago);
    EXPECT_EQ(sweep(), measured) << "another date alone";
    write_file_atomic(
        path("cd.json"),
        std::string_view(R"({"grating": {"pitch_nm": 1500, "profile": {"type": "slit", "width_nm": 800}}})"));
    std::filesystem::last_write_time(path("cd.json"), long_ago);
    EXPECT_EQ(sweep(), 2 * measured) << "another pitch of the same date and size";
}

/// Results that leave the buffer into nowhere are no success.
TEST_F(SweepFaults, StandardOutputThatCannotBeWrittenIsAFailure) {
    for (const test::Command& command :
         {test::Command{ROWLAND_TRADE, "project", "--probe", path("sky.hdr"), "--bands", "3"},
          test::Command{ROWLAND_COOK, "check", path("cd.json")}}) {
        const Ended ended = test::run(command, {.output = "/dev/full"});
        EXPECT_EQ(ended.code, 1) << command[0];
        EXPECT_THAT(ended.err, HasSubstr("standard output"));
    }
}

}  // namespace
}  // namespace rowland
