// The demo played with by real keys and drags under Xvfb. What an input is to change is compared with what the same
// steps without it leave as it was.
#include <gmock/gmock.h>

#include <thread>
#include <utility>

#include "engine/core/file.h"
#include "tests/support/folder_test.h"
#include "tests/window/demo_user.h"

namespace rowland {
namespace {

using test::DemoUser;
using test::difference;
using test::Region;
using test::operator""ms;
using test::operator""s;
using testing::HasSubstr;

constexpr int kPlayWidth = 320;
constexpr int kPlayHeight = 180;
constexpr Region kWhole{0, 0, kPlayWidth, kPlayHeight};
// Of --disc: left of the disc's hole, the diffuse sphere, and a point right of the hole.
constexpr Region kDisc{92, 45, 128, 105};
constexpr Region kDiffuseSphere{12, 100, 64, 150};
constexpr glm::ivec2 kOnDisc{210, 86};

/// What the demo says at its end of the state that the play ended in.
std::string state_in(const std::string& messages) {
    const std::size_t at = messages.rfind("played ");
    return at == std::string::npos ? std::string() : messages.substr(at, messages.find('\n', at) - at);
}

class PlayWindow : public test::FolderTest {
 protected:
    void SetUp() override { ROWLAND_NEEDS_VIRTUAL_DISPLAY(); }

    test::Command arguments(const test::Command& more = {}) const {
        test::Command result = {"--width",         std::to_string(kPlayWidth),
                                "--height",        std::to_string(kPlayHeight),
                                "--shader-folder", folder_.path()};
        result.insert(result.end(), more.begin(), more.end());
        return result;
    }
    /// A screenshot once maps are full.
    static image::ByteImage full_shot(DemoUser& user) {
        user.wait_for_maps(180s);
        return user.shot();
    }
};

TEST_F(PlayWindow, DragsThrowsLightsAndWalksChangeWhatTheyNameAndNothingElse) {
    DemoUser user(folder_.path(), arguments({"--disc", "--no-watch"}));
    user.key("space");
    {
        SCOPED_TRACE("a drag turns the disc and nothing else");
        const image::ByteImage first = user.shot();
        const image::ByteImage second = user.shot();
        user.drag(kOnDisc, {14, 9});
        const image::ByteImage turned = full_shot(user);
        EXPECT_EQ(difference(first, second, kDisc), 0.0);
        EXPECT_GT(difference(second, turned, kDisc), 10.0);
        // Measured: 0.1, by the light that the lifted disc keeps away.
        EXPECT_LT(difference(second, turned, kDiffuseSphere), 0.5);
    }
    {
        SCOPED_TRACE("a held key adds one light, which another key removes");
        user.point_at({160, 90});
        const image::ByteImage first = full_shot(user);
        user.key("g");
        const image::ByteImage one = full_shot(user);
        EXPECT_GT(difference(first, one, kWhole), 0.5);
        user.key("BackSpace");
        EXPECT_EQ(difference(first, full_shot(user), kWhole), 0.0);
        user.hold_key("g");
        std::this_thread::sleep_for(1500ms);  // longer than keys take to repeat
        user.release_key("g");
        EXPECT_EQ(difference(one, full_shot(user), kWhole), 0.0);
        user.key("BackSpace");
    }
    {
        SCOPED_TRACE("a thrown disc turns on by itself");
        // Where a busy machine takes the release for one after a rest it is thrown again, the other way: the disc
        // comes back to where the mouse is.
        double turned = 0.0;
        for (int attempt = 0; attempt < 4 && turned <= 10.0; ++attempt) {
            user.throw_from(kOnDisc, glm::ivec2(60, 30) * (attempt % 2 == 0 ? 1 : -1));
            // Paused, a throw waits; no hand causes what differs after that.
            const image::ByteImage first = full_shot(user);
            const image::ByteImage second = user.shot();
            EXPECT_EQ(difference(first, second, kDisc), 0.0);
            // Played on in short pieces until the turn shows: a slow machine draws few frames in each.
            for (int piece = 0; piece < 4 && turned <= 10.0; ++piece) {
                user.key("space");
                std::this_thread::sleep_for(1s);
                user.key("space");
                turned = difference(second, full_shot(user), kDisc);
            }
        }
        EXPECT_GT(turned, 10.0);
    }
    {
        SCOPED_TRACE("the environment turns there and back");
        const image::ByteImage first = full_shot(user);
        const auto turned = [&](const char* key) {
            for (int i = 0; i < 3; ++i) user.key(key);
            // A turn takes some frames.
            image::ByteImage before = full_shot(user);
            image::ByteImage after = full_shot(user);
            const auto is_done = [&] { return difference(before, after, kWhole) == 0.0; };
            for (int i = 0; i < 60 && !is_done(); ++i) before = std::exchange(after, full_shot(user));
            return after;
        };
        const double there = difference(first, turned("comma"), kWhole);
        EXPECT_GT(there, 1.0);
        // Maps may still be filling for the light as it stands again.
        EXPECT_LT(difference(first, turned("period"), kWhole), 0.3 * there);
    }
    {
        SCOPED_TRACE("a walk goes forward, and Escape only ends it");
        const image::ByteImage orbit = full_shot(user);
        user.key("c");
        const image::ByteImage start = user.settled_shot(60s);
        user.hold_key("w");
        std::this_thread::sleep_for(1s);
        user.release_key("w");
        const image::ByteImage end = user.settled_shot(60s);
        user.key("Escape");
        // The walk starts where the orbit was, but for rounding, and the orbit goes on from where the walk ended.
        EXPECT_LT(difference(orbit, start, kWhole), 0.5);
        EXPECT_GT(difference(start, end, kWhole), 5.0);
        EXPECT_LT(difference(end, user.settled_shot(60s), kWhole), 0.5);
    }
    user.leave();
}

TEST_F(PlayWindow, ARecordingPlaysAgainToTheSameStateWithAndWithoutAWindow) {
    const std::string file = path("play.jsonl");
    std::string recorded;
    {
        DemoUser user(folder_.path(), arguments({"--disc", "--no-watch", "--record", file}));
        user.key("space");
        user.throw_from(kOnDisc, {60, 30});
        for (const char* key : {"g", "comma", "m"}) user.key(key);
        user.drag({30, 100}, {40, 10});
        std::this_thread::sleep_for(500ms);
        recorded = state_in(user.leave());
    }
    ASSERT_THAT(recorded, HasSubstr("state "));
    const test::Ended headless =
        test::run({test::program_to_try("ROWLAND_TEST_PLAYER", ROWLAND_DEMO), "--disc", "--width", "96", "--height",
                   "54", "--output-folder", folder_.path(), "--play", file, "--headless"});
    ASSERT_EQ(headless.code, 0) << headless.err;
    EXPECT_EQ(state_in(headless.err), recorded);
    EXPECT_TRUE(std::filesystem::exists(path("play.png")));
    // In a window.
    std::filesystem::create_directory(path("window"));
    DemoUser user(path("window"), arguments({"--disc", "--no-watch", "--play", file}));
    user.wait_for_message("played", 120s);
    EXPECT_EQ(state_in(user.leave()), recorded);
}

TEST_F(PlayWindow, ASavedSceneIsShownAndTurnedObjectsStayTurned) {
    // In the opening view of the cabinet.
    constexpr Region kCabinetDisc{84, 84, 120, 114};
    constexpr Region kCabinetSphere{258, 102, 284, 124};
    constexpr glm::ivec2 kOnCabinetDisc{116, 101};
    const std::filesystem::path shown = path("room.glb");
    // Its gratings would be measured when it is cooked, and are not looked at.
    std::string plain = read_text_file(test::content_path("scenes/cabinet.glb"), 1 << 24);
    for (auto at = plain.find("ROWLAND_materials"); at != std::string::npos; at = plain.find("ROWLAND_materials"))
        plain.replace(at, 7, "UNKNOWN");
    write_file_atomic(shown, plain);
    std::filesystem::copy(std::filesystem::path(ROWLAND_DEMO).parent_path().parent_path() / "cooked", path("cooked"));
    std::string other = plain;
    const std::string plaster = R"("name":"plaster","pbrMetallicRoughness":{"baseColorFactor":[0.75,0.75,0.75)";
    ASSERT_NE(other.find(plaster), std::string::npos);
    other.replace(other.find(plaster), plaster.size(),
                  R"("name":"plaster","pbrMetallicRoughness":{"baseColorFactor":[0.75,0.05,0.75)");

    DemoUser user(folder_.path(), arguments({"--cooked-folder", path("cooked"), "--scene", shown}));
    user.key("space");
    user.drag(kOnCabinetDisc, {14, 9});
    std::this_thread::sleep_for(1s);
    const image::ByteImage first = full_shot(user);
    write_file_atomic(shown, other);
    user.shot_unlike(first, 60s);
    std::this_thread::sleep_for(1s);
    const image::ByteImage saved = full_shot(user);
    EXPECT_GT(difference(first, saved, kCabinetSphere), 10.0);
    // The disc's colours may be those of another moment of the maps' filling; its position and outline are the same.
    EXPECT_LT(difference(first, saved, kCabinetDisc), 5.0);
}

}  // namespace
}  // namespace rowland
