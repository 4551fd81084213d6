// The demo's panels, wipe and measured pixel, used by real clicks, drags and keys under Xvfb.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "engine/core/file.h"
#include "engine/image/byte_image.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/editor/trade/trade_run.h"
#include "tests/window/needs_xvfb.h"

namespace rowland {
namespace {

using testing::HasSubstr;

constexpr int kWidth = 900;  ///< the least for which panels are open from the start
constexpr int kHeight = 500;
/// The check box of the lamp, the last row of the first section.
constexpr const char* kLampBox = "click:30,150";

class HudWindow : public ::testing::Test {
 protected:
    HudWindow() {
        test::write_sweep_inputs(folder_.path());
        write_file_atomic(folder_.path() / "grating.json", material("1600"));
        write_file_atomic(folder_.path() / "other.json", material("1100"));
    }
    static std::string material(const char* pitch_nm) {
        return std::string(R"({"grating": {"pitch_nm": )") + pitch_nm +
               R"(, "profile": {"type": "slit", "width_nm": 400}},
                   "quality": {"representation": "transfer", "bands": 4}})";
    }
    /// The demo with one disc, so many pixels large.
    std::string demo() const {
        const std::string folder = folder_.path().string();
        return std::string(ROWLAND_DEMO) + " --disc --width " + std::to_string(kWidth) + " --height " +
               std::to_string(kHeight) + " --material " + folder + "/grating.json --probe " + folder +
               "/sky.hdr --light-window none --shader-folder " + folder;
    }
    /// Starts it with the disc at rest, plays the actions and ends it.
    void play(const std::vector<std::string>& actions, const std::string& arguments = {}) {
        std::string command = std::string("DROP_FILES=" ROWLAND_DROP_FILES " bash ") + ROWLAND_DRIVE + " " +
                              folder_.path().string() + " key:space";
        for (const std::string& action : actions) command += " '" + action + "'";
        command += " -- " + demo() + " " + arguments;
        EXPECT_EQ(std::system(command.c_str()), 0) << command;
    }
    /// The probe with its rows turned over.
    std::string turned_sky() const {
        const std::string sky = read_text_file(folder_.path() / "sky.hdr", 1 << 20);
        const std::size_t texels = sky.size() - std::size_t{32} * 16 * 4;
        std::string turned = sky.substr(0, texels);
        for (int row = 15; row >= 0; --row) turned += sky.substr(texels + static_cast<std::size_t>(row) * 128, 128);
        return turned;
    }
    image::ByteImage screenshot(int number) const {
        const std::filesystem::path path = folder_.path() / ("shot_" + std::to_string(number) + ".png");
        return image::decode_byte_image(read_file(path, 1 << 24), path.string());
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
    nlohmann::json pixel(int number) const {
        const std::filesystem::path path = folder_.path() / ("pixel_000" + std::to_string(number) + ".json");
        if (!std::filesystem::exists(path)) return {};
        return nlohmann::json::parse(read_text_file(path, 1 << 20));
    }
    /// The row that rowland-trade prints for a pixel that was written.
    std::vector<double> printed(int number, const std::string& arguments) const {
        const test::TradeRun run = test::run_trade(
            folder_.path(), "evaluate --frames pixel_000" + std::to_string(number) + ".csv " + arguments);
        EXPECT_EQ(run.exit_code, 0) << run.messages;
        std::istringstream lines(run.output);
        std::string header;
        std::getline(lines, header);
        std::vector<double> xyz(3);
        char comma = 0;
        lines >> xyz[0] >> comma >> xyz[1] >> comma >> xyz[2];
        EXPECT_TRUE(lines) << run.output;
        return xyz;
    }
    void expect_as_printed(int number, const std::string& pitch_material, const std::string& probe) const {
        const nlohmann::json shown = pixel(number);
        ASSERT_TRUE(shown.is_object()) << "pixel " << number << " was not written";
        const std::string light = "--probe " + probe;
        const std::vector<double> reference =
            printed(number, light + " --method reference --material " + pitch_material);
        const std::string folder = folder_.path().string();
        const std::string cook =
            std::string(ROWLAND_COOK) + " cook " + folder + "/" + pitch_material + " -o " + folder + "/cooked.material";
        ASSERT_EQ(std::system(cook.c_str()), 0) << cook;
        const std::vector<double> baked = printed(number, light + " --cooked cooked.material");
        double squares = 0.0;
        double of_reference = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            // Nine significant digits are printed.
            EXPECT_NEAR(shown["reference_xyz"][i].get<double>(), reference[i], 1e-8 * std::abs(reference[i]));
            EXPECT_NEAR(shown["shown_xyz"][i].get<double>(), baked[i], 1e-8 * std::abs(baked[i]));
            squares += std::pow(baked[i] - reference[i], 2.0);
            of_reference += reference[i] * reference[i];
        }
        EXPECT_GT(of_reference, 0.0);
        const double error = std::sqrt(squares / of_reference);
        EXPECT_NEAR(shown["relative_error"].get<double>(), error, 1e-6 * (1.0 + error));
    }

    test::TemporaryFolder folder_;
};

TEST_F(HudWindow, AClickInThePanelLightsTheLampAndHiddenPanelsTakeNone) {
    ROWLAND_NEEDS_XVFB();
    play({"shot", kLampBox, "other:20", "key:F2", kLampBox, "wait:1", "shot"});
    EXPECT_GT(differing(screenshot(1), screenshot(2), 0, kWidth), 0);
    EXPECT_EQ(differing(screenshot(2), screenshot(3), 0, kWidth), 0);
}

TEST_F(HudWindow, AWipeShowsTheOtherLookRightOfItsLineWhichIsDragged) {
    ROWLAND_NEEDS_XVFB();
    const int middle = kWidth / 2;
    const int moved = middle + 40;
    play({"shot", "key:x", "other:60", "dragat:450,250,40,0", "other:20", "key:x", "other:20"});
    // llvmpipe's scissor lets half the samples of the pixels before its edge through, and whichever look is drawn first
    // is seen there.
    EXPECT_EQ(differing(screenshot(1), screenshot(2), 0, middle - 1), 0);
    EXPECT_GT(differing(screenshot(1), screenshot(2), middle, kWidth), 0);
    EXPECT_EQ(differing(screenshot(1), screenshot(3), 0, moved - 1), 0);
    EXPECT_GT(differing(screenshot(1), screenshot(3), moved, kWidth), 0);
    EXPECT_GT(differing(screenshot(2), screenshot(3), middle, moved), 0);
    EXPECT_EQ(differing(screenshot(1), screenshot(4), 0, kWidth), 0);
}

TEST_F(HudWindow, WhatIsNoKeyIsRecorded) {
    ROWLAND_NEEDS_XVFB();
    const std::string folder = folder_.path().string();
    write_file_atomic(folder_.path() / "turned.hdr", turned_sky());
    play({"key:x", "wait:1", "dragat:450,250,40,0", "drop:" + folder + "/turned.hdr", "wait:1"},
         "--record " + folder + "/play.jsonl");
    const std::string recording = read_text_file(folder_.path() / "play.jsonl", 1 << 20);
    EXPECT_THAT(recording, HasSubstr(R"("set":"wipe","to":1.0)"));
    EXPECT_THAT(recording, HasSubstr(R"("set":"right look","to":"spikes, medium")"));
    EXPECT_THAT(recording, HasSubstr(R"("set":"wipe line","to":0.5)"));
    EXPECT_THAT(recording, HasSubstr(R"("set":"probe","to":")" + folder + "/turned.hdr"));
}

TEST_F(HudWindow, TheNextRepresentationIsShownWhenItIsBaked) {
    ROWLAND_NEEDS_XVFB();
    play({"at:590,240", "shot", "key:t", "other:60", "key:y", "other:60"});
    EXPECT_GT(differing(screenshot(1), screenshot(2), 0, kWidth), 0);
    EXPECT_GT(differing(screenshot(2), screenshot(3), 0, kWidth), 0);
}

TEST_F(HudWindow, ThePixelsErrorBecomesWhatEvaluatePrintsWhenMaterialAndProbeChange) {
    ROWLAND_NEEDS_XVFB();
    const std::string folder = folder_.path().string();
    const std::string sky = read_text_file(folder_.path() / "sky.hdr", 1 << 20);
    write_file_atomic(folder_.path() / "turned.hdr", turned_sky());
    write_file_atomic(folder_.path() / "first.hdr", sky);
    write_file_atomic(folder_.path() / "first.json", material("1600"));
    play({"at:590,240", "pixel:30", "shot", "run:cp " + folder + "/other.json " + folder + "/grating.json", "other:20",
          "wait:1", "pixel:30", "shot", "run:cp " + folder + "/turned.hdr " + folder + "/sky.hdr", "other:20", "wait:1",
          "pixel:30"});
    std::vector<int> written;
    for (int number = 0; pixel(number).is_object(); ++number) written.push_back(number);
    ASSERT_GE(written.size(), 3U);
    expect_as_printed(0, "first.json", "first.hdr");
    expect_as_printed(written.back(), "other.json", "turned.hdr");
    EXPECT_NE(pixel(0)["relative_error"], pixel(written.back())["relative_error"]);
}

}  // namespace
}  // namespace rowland
