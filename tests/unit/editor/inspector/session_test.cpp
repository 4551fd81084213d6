#include "editor/inspector/session.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/file.h"
#include "engine/platform/headless_context.h"
#include "tests/support/small_sky.h"
#include "tests/support/source_tree.h"
#include "tests/support/temporary_folder.h"

namespace rowland::inspector {
namespace {

using testing::HasSubstr;

/// A session without a window, whose picture is small and whose light is quick for the reference.
class SessionTest : public testing::Test {
 protected:
    SessionTest() {
        write_file_atomic(path("sky.json"), test::small_sky(64));
        write_file_atomic(
            path("m.json"),
            R"({"grating": {"pitch_nm": 1600, "orders": [1], "profile": {"type": "slit", "width_nm": 800}},
                              "quality": {"representation": "spikes", "bands": 3, "spikes": 2}})");
        session_.open(path("m.json"));
        session_.choose_light(path("sky.json"));
    }
    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

    void draw(int frames, bool with_saved = false) {
        for (int i = 0; i < frames; ++i) {
            session_.update();
            session_.draw({32, 24}, opening_camera(), with_saved, 0.01F);
        }
    }
    /// Frames until a condition holds; fails after two minutes.
    template <typename Condition>
    void draw_until(Condition&& holds, bool with_saved = false) {
        for (int i = 0; i < 24000 && !holds(); ++i) {
            draw(1, with_saved);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        EXPECT_TRUE(holds());
    }
    void draw_until_cooked(double pitch_nm, bool with_saved = false) {
        draw_until([&] { return session_.ready() && session_.cooked()->material.grating.pitch_nm == pitch_nm; },
                   with_saved);
    }
    /// Frames until all values are computed, which takes seconds.
    void settle() {
        draw_until([&] {
            session_.update();
            return session_.preview().drawn() && !session_.busy();
        });
    }
    const PricedChoice& present() {
        list_ = session_.prices();
        for (const PricedChoice& choice : list_.choices)
            if (choice.present) return choice;
        ADD_FAILURE() << "no present choice";
        list_.choices.emplace_back().settings = nlohmann::json::object();
        return list_.choices.back();
    }

    test::TemporaryFolder folder_;
    platform::HeadlessContext context_;
    post::OcioConfig config_ = post::OcioConfig::choose(std::nullopt);
    Session session_{config_, {.content_folder = test::source_path("content"), .still = true}};
    PriceList list_;
};

TEST_F(SessionTest, AllValuesFollowAnEdit) {
    settle();
    EXPECT_TRUE(session_.point_numbers_are_current());
    EXPECT_TRUE(session_.prices_are_current());
    const double error = present().error;
    const glm::dvec3 before = session_.point_numbers()->radiance.reference;
    session_.document().set_value(field_at("/grating/pitch_nm"), 900);
    draw(1);
    EXPECT_FALSE(session_.prices_are_current());
    EXPECT_TRUE(session_.busy());
    EXPECT_NE(session_.cooked(), nullptr);  // the last good one is shown until there is another
    settle();
    EXPECT_EQ(session_.cooked()->material.grating.pitch_nm, 900.0);
    EXPECT_NE(session_.point_numbers()->radiance.reference, before);
    EXPECT_TRUE(session_.prices_are_current());
    EXPECT_NE(present().error, error);
}

TEST_F(SessionTest, TheMaterialIsLookedThrough) {
    session_.stage.exposure_stops = 6.0F;  // so that the sky is bright enough
    settle();
    draw(3);
    const std::vector<std::uint8_t> without = session_.preview().display().read_rgba8();
    session_.looks_through = true;
    draw(3);
    EXPECT_NE(session_.preview().display().read_rgba8(), without);
    session_.looks_through = false;
    draw(3);
    EXPECT_EQ(session_.preview().display().read_rgba8(), without);
}

TEST_F(SessionTest, MeasuredPricesStayWhileOnlyTheChoiceChanges) {
    settle();
    session_.price();
    draw_until([&] { return !session_.prices().choices.empty() && session_.prices().total > 20; });
    session_.stop_pricing();
    settle();
    const std::size_t measured = session_.prices().choices.size();
    EXPECT_EQ(present().settings["spikes"], 2);
    EXPECT_TRUE(session_.prices_are_current());

    session_.document().replace_quality({{"representation", "spikes"}, {"bands", 3}, {"spikes", 3}});
    EXPECT_TRUE(session_.prices_are_current());
    settle();
    EXPECT_EQ(session_.prices().choices.size(), measured + 1);  // the new choice is measured in addition
    EXPECT_EQ(present().settings["spikes"], 3);
    session_.document().undo();
    EXPECT_EQ(present().settings["spikes"], 2);

    session_.document().set_value(field_at("/grating/pitch_nm"), 900);
    EXPECT_FALSE(session_.prices_are_current());
}

TEST_F(SessionTest, APresetOpensOnTheShapeThatShowsItsColours) {
    session_.open_preset("blu_ray");
    EXPECT_EQ(session_.shape(), PreviewShape::Sheet);
    session_.open_preset("cd");
    EXPECT_EQ(session_.shape(), PreviewShape::Disc);
}

TEST_F(SessionTest, ACookToABudgetMeasuresWhatItNeeds) {
    settle();
    session_.cook_to_budget(0.2);
    EXPECT_TRUE(session_.document().material().quality.pinned.has_value());
    settle();
    const auto expected = cheapest_within(session_.prices(), 0.2);
    ASSERT_TRUE(expected.has_value());
    EXPECT_EQ(nlohmann::json(session_.document().json()["quality"]), expected->settings);
    EXPECT_LE(present().error, 0.2);
}

TEST_F(SessionTest, AnEditEndsACookToABudget) {
    settle();
    session_.cook_to_budget(0.2);
    draw(2);
    session_.document().set_value(field_at("/grating/pitch_nm"), 900);
    draw(2);
    EXPECT_THAT(session_.messages().back().text, HasSubstr("an edit ended the measurement"));
    EXPECT_EQ(session_.document().json()["quality"]["spikes"], 2);
}

/// A grating that sends next to nothing on: what a cover adds to the preview is its gloss.
TEST_F(SessionTest, AGlossIsSeenInThePreviewAndTakenBack) {
    session_.document().set_value(field_at("/grating/profile/width_nm"), 1);
    session_.document().finish_edit();
    const auto drawn = [&](bool covered) {
        draw_until([&] {
            return session_.ready() && session_.cooked()->material.grating.cover.has_value() == covered &&
                   session_.cooked()->material.grating.profile.index() == 0;
        });
        draw(20);
        return session_.preview().linear().read_rgba_float();
    };
    const auto bare = drawn(false);
    session_.document().set_choice(field_at("/cover"), "over the grooves");
    const auto covered = drawn(true);
    int brighter = 0;
    for (std::size_t i = 0; i < bare.size(); ++i) brighter += covered[i].y > 1.3F * bare[i].y ? 1 : 0;
    EXPECT_GT(brighter, 40);  // of 768 pixels
    session_.document().undo();
    EXPECT_EQ(drawn(false), bare);
}

TEST_F(SessionTest, WhatIsSavedIsDrawnInAnIdleInspector) {
    draw_until([&] { return session_.ready() && session_.saved(); }, true);
    session_.document().set_value(field_at("/grating/pitch_nm"), 900);
    draw_until_cooked(900.0, true);
    draw(100, true);  // the picture is at rest
    const auto now = session_.preview().display().read_rgba8();
    EXPECT_NE(session_.preview().saved_display().read_rgba8(), now);
    session_.save();
    draw_until([&] { return session_.saved()->material.grating.pitch_nm == 900.0; }, true);
    draw(3, true);
    EXPECT_EQ(session_.preview().saved_display().read_rgba8(), now);
}

TEST_F(SessionTest, AModelIsDrawnInPlaceOfAnotherInAnIdleInspector) {
    const auto gltf = [](const char* scale) {
        // One triangle, unindexed, with its positions as base64: (0,0,0) (1,0,0) (0,1,0).
        return std::string(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0, "scale": )") +
               scale + R"(}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 0]}]})";
    };
    write_file_atomic(path("wide.gltf"), gltf("[1, 0.2, 1]"));
    write_file_atomic(path("tall.gltf"), gltf("[0.2, 1, 1]"));
    session_.open(path("wide.gltf"));
    draw_until([&] { return session_.shape() == PreviewShape::Model && session_.ready(); });
    draw(100);
    const auto wide = session_.preview().display().read_rgba8();
    session_.open(path("tall.gltf"));
    session_.finish_opening();
    draw(3);
    EXPECT_NE(session_.preview().display().read_rgba8(), wide);
}

TEST_F(SessionTest, ALightThatIsRefusedBecomesAMessageAndTheOldOneStays) {
    draw_until_cooked(1600.0);
    session_.choose_light(path("none.hdr"));
    draw_until([&] { return session_.messages().back().failure; });
    EXPECT_THAT(session_.messages().back().text, HasSubstr("none.hdr"));
    EXPECT_EQ(session_.light()->path, path("sky.json"));
}

TEST_F(SessionTest, AnOpenedTableIsComparedWithAScalarProfileAndTheLastScalarProfileWithATable) {
    draw_until_cooked(1600.0);
    EXPECT_FALSE(session_.compared());
    write_file_atomic(path("table.csv"), "wavelength_nm,R-1,R+0,R+1\n380,.2,.3,.2\n780,.1,.4,.1\n");
    session_.open(path("table.csv"));
    ASSERT_TRUE(session_.compared());
    EXPECT_TRUE(std::holds_alternative<diffraction::EfficiencyTable>(session_.compared()->profile));
    session_.document().set_value(field_at("/grating/profile"), {{"type", "table"}, {"file", "table.csv"}});
    draw_until([&] {
        return std::holds_alternative<diffraction::EfficiencyTable>(session_.cooked()->material.grating.profile);
    });
    ASSERT_TRUE(session_.compared());
    EXPECT_TRUE(std::holds_alternative<diffraction::SlitProfile>(session_.compared()->profile));
}

}  // namespace
}  // namespace rowland::inspector
