// The demo's panels, wipe and measured pixel, used by real clicks, drags and keys under Xvfb.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "engine/core/file.h"
#include "engine/core/text.h"
#include "tests/support/folder_test.h"
#include "tests/unit/editor/trade/trade_run.h"
#include "tests/window/demo_user.h"

namespace rowland {
namespace {

using test::DemoUser;
using test::operator""s;
using testing::HasSubstr;

constexpr int kWidth = 900;
constexpr int kHeight = 500;
/// The check box of the lamp, the last row of the first section.
constexpr glm::ivec2 kLampBox{30, 150};
/// On the disc.
constexpr glm::ivec2 kOnGrating{590, 240};

class HudWindow : public test::FolderTest {
 protected:
    HudWindow() {
        test::write_sweep_inputs(folder_.path());
        write_file_atomic(folder_.path() / "grating.json", material("1600"));
        write_file_atomic(folder_.path() / "other.json", material("1100"));
    }
    static std::string material(const char* pitch_nm) {
        return std::string(R"({"grating": {"pitch_nm": )") + pitch_nm +
               R"(, "profile": {"type": "slit", "width_nm": 400}},
                   "quality": {"representation": "spikes", "bands": 4}})";
    }
    void SetUp() override { ROWLAND_NEEDS_VIRTUAL_DISPLAY(); }
    /// Arguments for one disc under a small probe.
    test::Command arguments(const test::Command& more = {}) const {
        test::Command result = {"--disc",
                                "--width",
                                std::to_string(kWidth),
                                "--height",
                                std::to_string(kHeight),
                                "--material",
                                path("grating.json"),
                                "--probe",
                                path("sky.hdr"),
                                "--light-window",
                                "none",
                                "--shader-folder",
                                folder_.path()};
        result.insert(result.end(), more.begin(), more.end());
        return result;
    }
    /// The probe with its rows turned over.
    std::string turned_sky() const {
        const std::string sky = read_text_file(folder_.path() / "sky.hdr", 1 << 20);
        const std::size_t texels = sky.size() - std::size_t{32} * 16 * 4;
        std::string turned = sky.substr(0, texels);
        for (int row = 15; row >= 0; --row) turned += sky.substr(texels + static_cast<std::size_t>(row) * 128, 128);
        return turned;
    }
    /// How many pixels differ in the columns [begin, end).
    static int differing(const image::ByteImage& a, const image::ByteImage& b, int begin, int end) {
        EXPECT_EQ(a.rgba.size(), b.rgba.size());
        int count = 0;
        for (int row = 0; row < a.height; ++row)
            for (int column = begin; column < end; ++column) {
                const auto at = static_cast<std::ptrdiff_t>(4 * (row * a.width + column));
                if (!std::equal(a.rgba.begin() + at, a.rgba.begin() + at + 4, b.rgba.begin() + at)) ++count;
            }
        return count;
    }
    /// The reference in a pixel's JSON is the row that rowland-trade prints for its CSV.
    void expect_as_printed(std::filesystem::path pixel, const std::string& material, const std::string& probe) const {
        ASSERT_TRUE(std::filesystem::exists(pixel)) << pixel << " was not written";
        const nlohmann::json shown = nlohmann::json::parse(read_text_file(pixel, 1 << 20));
        const test::Ended run = test::run_trade(
            folder_.path(), fmt::format("evaluate --frames '{}' --probe {} --material {} --method reference",
                                        pixel.replace_extension(".csv").string(), probe, material));
        ASSERT_EQ(run.code, 0) << run.err;
        const auto xyz = parse_number_table(run.out, "evaluate", "X,Y,Z").rows.at(0);
        for (std::size_t i = 0; i < 3; ++i)
            // Nine significant digits are printed.
            EXPECT_NEAR(shown["reference_xyz"][i].get<double>(), xyz[i], 1e-8 * std::abs(xyz[i]));
    }
};

/// One session: a click in the panel, the wipe, the next representations and a dropped probe, all recorded.
TEST_F(HudWindow, PanelsWipeAndRepresentationsShowAndAreRecorded) {
    write_file_atomic(path("turned.hdr"), turned_sky());
    {
        DemoUser user(folder_.path(), arguments({"--record", path("play.jsonl")}));
        user.key("space");
        user.key("F2");
        const image::ByteImage dark = user.shot();
        user.click(kLampBox);
        const image::ByteImage lit = user.shot_unlike(dark, 60s);
        EXPECT_GT(differing(dark, lit, 0, kWidth), 0);
        user.key("F2");
        const image::ByteImage hidden = user.settled_shot(60s);
        user.click(kLampBox);
        EXPECT_EQ(differing(hidden, user.settled_shot(60s), 0, kWidth), 0) << "hidden panels take no clicks";

        const int middle = kWidth / 2;
        const int moved = middle + 40;
        user.point_at(kOnGrating);
        const image::ByteImage one_look = user.settled_shot(60s);
        user.key("x");
        const image::ByteImage two_looks = user.shot_unlike(one_look, 60s);
        user.drag({middle, kHeight / 2}, {moved - middle, 0});
        const image::ByteImage dragged = user.shot_unlike(two_looks, 60s);
        user.key("x");
        const image::ByteImage again = user.shot_unlike(dragged, 60s);
        // llvmpipe's scissor lets half the samples of the pixels before its edge through, and whichever look is drawn
        // first is seen there.
        EXPECT_EQ(differing(one_look, two_looks, 0, middle - 1), 0);
        EXPECT_GT(differing(one_look, two_looks, middle, kWidth), 0);
        EXPECT_EQ(differing(one_look, dragged, 0, moved - 1), 0);
        EXPECT_GT(differing(one_look, dragged, moved, kWidth), 0);
        EXPECT_GT(differing(two_looks, dragged, middle, moved), 0);
        EXPECT_EQ(differing(one_look, again, 0, kWidth), 0);

        user.point_at(kOnGrating);
        const image::ByteImage first = user.settled_shot(60s);
        user.key("t");
        const image::ByteImage second = user.shot_unlike(first, 60s);
        EXPECT_GT(differing(first, second, 0, kWidth), 0) << "the next representation, once it is baked";
        user.key("y");
        const image::ByteImage third = user.shot_unlike(second, 60s);
        EXPECT_GT(differing(second, third, 0, kWidth), 0);
        user.drop(path("turned.hdr"));
        user.shot_unlike(third, 60s);
    }
    const std::string recording = text("play.jsonl");
    EXPECT_THAT(recording, HasSubstr(R"("set":"wipe","to":1.0)"));
    EXPECT_THAT(recording, HasSubstr(R"("set":"right look","to":"spikes, medium")"));
    EXPECT_THAT(recording, HasSubstr(R"("set":"wipe line","to":0.5)"));
    EXPECT_THAT(recording, HasSubstr(R"("set":"probe","to":")" + path("turned.hdr").string()));
}

TEST_F(HudWindow, TheMeasuredPixelIsWhatEvaluatePrintsAndFollowsMaterialAndProbe) {
    write_file_atomic(path("turned.hdr"), turned_sky());
    DemoUser user(folder_.path(), arguments());
    user.key("space");
    user.key("F2");
    user.point_at(kOnGrating);
    // Waits until the file that was written shows.
    const auto replace = [&](const char* file, const std::string& content) {
        const image::ByteImage before = user.shot();
        write_file_atomic(path(file), content);
        user.shot_unlike(before, 60s);
        std::this_thread::sleep_for(1s);
    };
    const std::filesystem::path first = user.measured_pixel(30s);
    replace("grating.json", material("1100"));
    replace("sky.hdr", turned_sky());
    const std::filesystem::path last = user.measured_pixel(30s);
    expect_as_printed(last, "other.json", "turned.hdr");
    EXPECT_NE(read_text_file(first, 1 << 20), read_text_file(last, 1 << 20));
}

}  // namespace
}  // namespace rowland
