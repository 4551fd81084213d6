// The real cooker when things go wrong around it.
#include <gmock/gmock.h>

#include <csignal>
#include <set>

#include "tests/faults/moments.h"
#include "tests/faults/small_disk.h"
#include "tests/support/folder_test.h"

namespace rowland {
namespace {

using test::Ended;
using test::Moment;
using testing::AllOf;
using testing::AnyOf;
using testing::Eq;
using testing::HasSubstr;

constexpr int kManyMoments = 1000;  ///< more than any of these cooks has

/// A grating that is cooked in a moment, and that names another file.
std::string material(int pitch_nm) {
    return R"({"grating": {"pitch_nm": )" + std::to_string(pitch_nm) +
           R"(, "profile": {"type": "table", "file": "efficiency.csv"}, "orders": [-1, 1]},
               "quality": {"representation": "spikes", "bands": 3, "spikes": 2, "view_resolution": 8}})";
}

std::string efficiency(const char* share) {
    std::string text = "wavelength_nm,R-1,R+0,R+1\n";
    for (const char* wavelength : {"380", "580", "780"})
        text += std::string(wavelength) + "," + share + ",0.2," + share + "\n";
    return text;
}

class CookFaults : public test::FolderTest {
 protected:
    CookFaults() {
        write("grating.json", material(1600));
        write("efficiency.csv", efficiency("0.1"));
        std::filesystem::create_directory(path("out"));
    }

    test::Command cook_to(const std::filesystem::path& output) const {
        return {ROWLAND_COOK, "cook", path("grating.json"), "-o", output, "--threads", "1"};
    }
    /// What an undisturbed cook of what is there now gives.
    std::string cooked() const {
        const Ended ended = test::run(cook_to(path("undisturbed")));
        EXPECT_EQ(ended.code, 0) << ended.err;
        return text("undisturbed");
    }
    std::set<std::string> outputs() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path("out")))
            names.insert(entry.path().filename());
        return names;
    }
};

TEST_F(CookFaults, KilledAtAnyMomentItLeavesTheOldAssetOrTheNewOneWhole) {
    const std::string before = cooked();
    write("grating.json", material(1500));
    const std::string after = cooked();
    ASSERT_NE(before, after);
    int with_litter = 0;
    int number = 0;
    for (bool killed = true; killed; ++number) {
        ASSERT_LT(number, kManyMoments);
        write("out/asset", before);
        killed = false;
        const Ended ended =
            test::run_with_moments(cook_to(path("out/asset")), folder_.path(), [&](const Moment& moment) {
                killed = killed || moment.number == number;
                return moment.number != number;
            });
        EXPECT_EQ(ended.code, killed ? 128 + SIGKILL : 0) << number << ended.err;
        EXPECT_THAT(text("out/asset"), AnyOf(Eq(killed ? before : after), Eq(after))) << number;
        std::set<std::string> litter = outputs();
        litter.erase("asset");
        for (const std::string& name : litter) {
            EXPECT_TRUE(name.starts_with(".rowland-")) << name;
            EXPECT_EQ(text("out/" + name), after) << "the file is no torn asset";
            std::filesystem::remove(path("out/" + name));
        }
        with_litter += litter.empty() ? 0 : 1;
    }
    EXPECT_GT(number, 10) << "it was stopped nowhere";
    EXPECT_LE(with_litter, 1) << "killed after a file was complete and before it replaced the old one";
}

TEST_F(CookFaults, AfterAKillTheNextCookGivesTheBytesOfAnUndisturbedOne) {
    const std::string undisturbed = cooked();
    test::run_with_moments(cook_to(path("out/asset")), folder_.path(),
                           [](const Moment& moment) { return moment.call != "fsync"; });
    EXPECT_FALSE(std::filesystem::exists(path("out/asset")));
    EXPECT_EQ(test::run(cook_to(path("out/asset"))).code, 0);
    EXPECT_EQ(text("out/asset"), undisturbed);
}

/// One cook stands still at each of its moments while another goes from its beginning to its end.
TEST_F(CookFaults, TwoCooksAtOnceInOneFolderBothSucceed) {
    const std::string undisturbed = cooked();
    for (const char* other : {"asset", "other"}) {
        int moments = 0;
        const Ended ended = test::run_with_moments(cook_to(path("out/asset")), path("out"), [&](const Moment&) {
            ++moments;
            const Ended second = test::run(cook_to(path("out") / other));
            EXPECT_EQ(second.code, 0) << second.err;
            EXPECT_EQ(text(std::string("out/") + other), undisturbed);
            return true;
        });
        EXPECT_EQ(ended.code, 0) << ended.err;
        EXPECT_GT(moments, 3) << "nothing was at once";
        EXPECT_EQ(text("out/asset"), undisturbed);
        EXPECT_EQ(outputs(), (std::set<std::string>{"asset", other}));
        std::filesystem::remove(path("out") / other);
    }
}

/// At each moment of a cook somebody saves one of its sources: what comes out is of one state of the sources, or
/// nothing does.
TEST_F(CookFaults, SourceChangedAtAnyMomentIsCookedAsOldOrNewOrNotAtAll) {
    struct Change {
        const char* file;
        std::string before;
        std::string after;
    };
    for (const Change& change : {Change{"grating.json", material(1600), material(1500)},
                                 Change{"efficiency.csv", efficiency("0.1"), efficiency("0.2")}}) {
        const std::string old_asset = cooked();
        write(change.file, change.after);
        const std::string new_asset = cooked();
        ASSERT_NE(old_asset, new_asset);
        int refused = 0;
        bool changed = true;
        for (int number = 0; changed; ++number) {
            ASSERT_LT(number, kManyMoments);
            std::filesystem::remove(path("out/asset"));
            write(change.file, change.before);
            changed = false;
            const Ended ended =
                test::run_with_moments(cook_to(path("out/asset")), folder_.path(), [&](const Moment& moment) {
                    if (moment.number != number) return true;
                    changed = true;
                    write(change.file, change.after);
                    return true;
                });
            if (ended.code == 0) {
                EXPECT_THAT(text("out/asset"), AnyOf(Eq(old_asset), Eq(new_asset))) << change.file << number;
                continue;
            }
            ++refused;
            EXPECT_EQ(ended.code, 1) << ended.err;
            EXPECT_THAT(ended.err, AllOf(HasSubstr(change.file), HasSubstr("changed while it was being cooked")));
            EXPECT_EQ(outputs(), std::set<std::string>{});
        }
        EXPECT_GT(refused, 0) << "it was never changed between two looks";
        write(change.file, change.before);
    }
}

/// As above, but changed back before the cooker looks again.
TEST_F(CookFaults, SourceChangedForAMomentIsNeverCookedUnderTheOldOnesName) {
    const std::string undisturbed = cooked();
    int refused = 0;
    bool changed = true;
    for (int number = 0; changed; ++number) {
        ASSERT_LT(number, kManyMoments);
        std::filesystem::remove(path("out/asset"));
        write("efficiency.csv", efficiency("0.1"));
        changed = false;
        // For as long as one file is opened and read.
        const Ended ended =
            test::run_with_moments(cook_to(path("out/asset")), folder_.path(), [&](const Moment& moment) {
                if (moment.number == number) {
                    changed = true;
                    write("efficiency.csv", efficiency("0.2"));
                }
                if (moment.number == number + 2) write("efficiency.csv", efficiency("0.1"));
                return true;
            });
        if (ended.code == 0)
            EXPECT_EQ(text("out/asset"), undisturbed) << number;
        else
            ++refused;
    }
    EXPECT_GT(refused, 0) << "it was never read while it was another";
}

TEST_F(CookFaults, OnAFullDiskItKeepsTheOldAssetAndSaysWhy) {
    const test::SmallDisk disk(512);
    ROWLAND_NEEDS_MOUNTED(disk);
    const std::filesystem::path asset = disk.path() / "asset";
    write_file_atomic(asset, std::string_view("old"));
    disk.fill_but(0);
    const Ended full = test::run(cook_to(asset));
    EXPECT_EQ(full.code, 1);
    EXPECT_EQ(full.err, "error: " + asset.string() +
                            ": writing failed: No space left on device; check permissions and free space\n");
    EXPECT_EQ(read_text_file(asset, 100), "old");
    disk.free_again();
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(disk.path()), {}), 1) << "only the asset is there";
    EXPECT_EQ(test::run(cook_to(asset)).code, 0);
    EXPECT_EQ(read_text_file(asset, 1 << 24), cooked());
}

TEST_F(CookFaults, IntoAReadOnlyFolderNothingIsWrittenAndTheMessageSaysWhy) {
    write("out/asset", "old");
    std::filesystem::permissions(path("out"), std::filesystem::perms(0555));
    for (const char* name : {"out/asset", "out/new", "out/folder/new"}) {
        const Ended ended = test::run(cook_to(path(name)), {.obey_modes = true});
        EXPECT_EQ(ended.code, 2) << name << ": known before work begins";
        EXPECT_THAT(ended.err, AllOf(HasSubstr(path("out").string()), HasSubstr("Permission denied"),
                                     HasSubstr("name another file")));
    }
    EXPECT_EQ(text("out/asset"), "old");
    EXPECT_EQ(outputs(), std::set<std::string>{"asset"});
}

TEST_F(CookFaults, OntoAReadOnlyFileSystemNothingIsWrittenAndTheMessageSaysWhy) {
    const test::SmallDisk disk(512);
    ROWLAND_NEEDS_MOUNTED(disk);
    disk.make_read_only();
    const Ended ended = test::run(cook_to(disk.path() / "folder" / "asset"));
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, AllOf(HasSubstr(disk.path().string()), HasSubstr("Read-only file system")));
}

/// Sources and assets from the future, and a clock that goes back an hour whenever somebody looks.
TEST_F(CookFaults, ClockSetBackChangesNoByte) {
    const std::string undisturbed = cooked();
    using std::chrono::hours;
    const auto now = std::filesystem::file_time_type::clock::now();
    write("out/asset", "old");
    for (const hours shift : {hours(24 * 365), hours(-24 * 365 * 40)}) {
        std::filesystem::last_write_time(path("grating.json"), now + shift);
        std::filesystem::last_write_time(path("out/asset"), now - shift);
        const Ended ended = test::run(cook_to(path("out/asset")), {.preload = ROWLAND_CLOCK_SET_BACK});
        EXPECT_EQ(ended.code, 0) << ended.err;
        EXPECT_EQ(text("out/asset"), undisturbed);
    }
}

}  // namespace
}  // namespace rowland
