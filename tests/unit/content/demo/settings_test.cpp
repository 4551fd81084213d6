// What the user sets with sliders and lists, as the session carries it out.
#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "content/demo/play/body.h"
#include "content/demo/session.h"
#include "engine/cook/cook_source.h"
#include "engine/core/file.h"
#include "engine/platform/gl_context.h"
#include "modules/diffraction/runtime/rung_control.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::demo {
namespace {

class DemoSettings : public ::testing::Test {
 protected:
    DemoSettings() {
        options_.watch = false;
        options_.cooked_folder = std::filesystem::path(ROWLAND_DEMO).parent_path().parent_path() / "cooked";
        options_.scene = options_.cooked_folder / "cabinet.scene";
        open();
    }
    void open() { session_.emplace(options_, config_, size_, size_, Pace::Fluent); }
    /// Through a step of the play, as from a panel or a recording.
    void set(const SettingEvent& event) {
        const std::vector<PlayEvent> events{event};
        session_->play().step(events);
        EXPECT_TRUE(session_->carry_out().empty());
    }
    const post::PostSettings& post() { return session_->picture().post_settings(); }

    glm::ivec2 size_{64, 36};
    platform::HeadlessContext context_;
    Options options_;
    post::OcioConfig config_ = post::OcioConfig::choose(std::nullopt);
    std::optional<Session> session_;
};

/// Under a budget, of which the test's machine cannot choose another rung than the cheapest or the best.
class DemoBudget : public DemoSettings {
 protected:
    void open_with(double gratings_ms, bool plays_back) {
        size_ = {96, 54};
        options_.gratings_ms = gratings_ms;
        if (plays_back) options_.play = "recording.jsonl";
        open();
    }
    void draw() {
        session_->draw(1.0F / 30.0F);
        glFinish();  // what was measured is known in the next frame
    }
    std::vector<std::size_t> rungs() {
        std::vector<std::size_t> rungs;
        for (const ecs::Entity grating : session_->comparison().gratings())
            rungs.push_back(session_->play().world().get<diffraction::DrawnRung>(grating).wanted);
        return rungs;
    }
};

TEST_F(DemoBudget, APlaybackDrawsTheRungsThatWereChosenInTheRecordedPlay) {
    constexpr int kMostFrames = 60;  // until draws were measured
    open_with(1e-6, false);
    std::vector<PlayEvent> chosen;
    for (int frame = 0; frame < kMostFrames && chosen.empty(); ++frame) {
        draw();
        chosen = session_->take_chosen_rungs();
    }
    const std::vector<std::size_t> cheapest = rungs();
    ASSERT_FALSE(chosen.empty());

    open_with(1e6, true);
    draw();
    const std::vector<std::size_t> best = rungs();
    EXPECT_NE(best, cheapest);
    session_->play().step(chosen);
    EXPECT_TRUE(session_->carry_out().empty());
    draw();
    EXPECT_EQ(rungs(), cheapest);
    set({Setting::Rung, 1.0, "99"});
    EXPECT_THAT(session_->messages().back().text, testing::HasSubstr("gratings"));
    session_->end_playback();
    // The fade to the recorded rungs ends before another begins.
    for (int frame = 0; frame < kMostFrames + diffraction::kMostFadeFrames && rungs() != best; ++frame) draw();
    EXPECT_EQ(rungs(), best);
}

/// What the demo ships is cooked by the build.
TEST_F(DemoSettings, AStartBakesNothing) {
    const std::uint64_t before = cook::sources_baked();
    session_.reset();
    open();
    EXPECT_EQ(cook::sources_baked(), before);
}

TEST_F(DemoSettings, TheFirstViewIsOfANamedObjectOrAsGiven) {
    options_.frame_object = "mirror sphere";
    open();
    const auto hit = session_->play().hit_at(0.5 * glm::dvec2(size_));
    ASSERT_TRUE(hit);
    const ecs::Entity seen = session_->play().toys().targets[hit->target].entity;
    EXPECT_EQ(name_of_object(session_->play().world(), seen), "mirror sphere");
    options_.frame_object = "no such thing";
    EXPECT_THAT(test::message_of([&] { open(); }),
                testing::AllOf(testing::HasSubstr("--frame-object"), testing::HasSubstr("mirror sphere")));
    options_.frame_object.reset();
    options_.camera = {0.0F, 0.5F, 0.8F, 0.0F, 0.1F, 0.0F};
    open();
    EXPECT_LT(glm::distance(session_->play().camera().eye, glm::vec3(0.0F, 0.5F, 0.8F)), 1e-5F);
    EXPECT_EQ(session_->play().camera().target, glm::vec3(0.0F, 0.1F, 0.0F));
}

TEST_F(DemoSettings, NumbersAreTaken) {
    set({Setting::Exposure, -1.25});
    EXPECT_EQ(post().exposure_stops, -1.25F);
    const std::vector<PlayEvent> effects{ActionEvent{Action::Bloom}, SettingEvent{Setting::Bloom, 0.75},
                                         ActionEvent{Action::Vignette}, SettingEvent{Setting::Vignette, 0.25}};
    const bool had_bloom = post().bloom.has_value();
    const bool had_vignette = post().vignette.has_value();
    session_->play().step(effects);
    session_->carry_out();
    ASSERT_NE(post().bloom.has_value(), had_bloom);
    ASSERT_NE(post().vignette.has_value(), had_vignette);
    // Of an effect that is off nothing is set.
    EXPECT_EQ(post().bloom ? post().bloom->strength : 0.75F, 0.75F);
    EXPECT_EQ(post().vignette ? post().vignette->strength : 0.25F, 0.25F);
    set({Setting::FNumber, 4.0});
    set({Setting::Grain, 0.1});
    EXPECT_FALSE(post().depth_of_field);
    EXPECT_FALSE(post().grain);
    const std::vector<PlayEvent> lens{ActionEvent{Action::DepthOfField}, ActionEvent{Action::Grain}};
    session_->play().step(lens);
    session_->carry_out();
    set({Setting::FNumber, 4.0});
    set({Setting::Grain, 0.1});
    EXPECT_EQ(post().depth_of_field.value().f_number, 4.0F);
    EXPECT_EQ(post().grain.value().strength, 0.1F);
    set({Setting::Wipe, 1.0});
    set({Setting::WipeLine, 0.3});
    EXPECT_TRUE(session_->comparison().wiping());
    EXPECT_EQ(session_->comparison().line(), 0.3F);
    set({Setting::Wipe, 0.0});
    EXPECT_FALSE(session_->comparison().wiping());
}

TEST_F(DemoSettings, OneLooksThroughTheNextSheetOrThroughNone) {
    const auto press = [&] {
        const std::vector<PlayEvent> events{ActionEvent{Action::Glare}};
        session_->play().step(events);
        session_->carry_out();
    };
    // Without a folder of materials there is nothing to look through.
    press();
    EXPECT_FALSE(post().glare);
    options_.glare = test::content_path("materials/screen_door.json");
    open();
    ASSERT_TRUE(post().glare);
    EXPECT_EQ(session_->sheet(), "screen_door");
    EXPECT_FALSE(post().glare->pattern->points.empty());
    press();
    EXPECT_FALSE(post().glare);
    EXPECT_EQ(session_->sheet(), "");
    press();
    EXPECT_TRUE(post().glare);
    options_.glare = "no_such_sheet.json";
    EXPECT_THROW(open(), Error);
}

TEST_F(DemoSettings, AScenesCameraLooksThroughItsSheet) {
    const std::string with_glare = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 2], "extras": {"glare": {"grating": {
            "pitch_nm": 2000, "profile": {"type": "slit", "width_nm": 900}, "orders": [-1, 1]}, "grooveRotation": 0.5}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.01}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36,
            "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    const test::TemporaryFolder folder;
    options_.scene = folder.path() / "triangle.gltf";
    write_file_atomic(*options_.scene, with_glare);
    open();
    ASSERT_TRUE(post().glare);
    EXPECT_EQ(post().glare->angle, 0.5F);
    EXPECT_EQ(session_->sheet(), "triangle.gltf's camera");

    std::string wrong = with_glare;
    wrong.replace(wrong.find("\"pitch_nm\": 2000"), 16, "\"pitch_nm\": -200");
    write_file_atomic(*options_.scene, wrong);
    EXPECT_THAT(test::message_of([&] { open(); }),
                testing::HasSubstr("triangle.gltf's camera: /extras/glare/grating/pitch_nm"));
}

TEST_F(DemoSettings, ProbesAndViewsAreTakenByNameAndUnknownOnesLeaveTheOld) {
    set({Setting::Probe, "night"});
    EXPECT_EQ(session_->probe_path().stem(), "night");
    set({Setting::Probe, "/nowhere/none.hdr"});
    EXPECT_EQ(session_->probe_path().stem(), "night");
    ASSERT_GE(session_->views().size(), 2U);
    for (const std::string& view : session_->views()) {
        set({Setting::View, view});
        EXPECT_EQ(session_->view(), view);
    }
    const std::string before = session_->view();
    set({Setting::View, "no view"});
    EXPECT_EQ(session_->view(), before);
}

TEST_F(DemoSettings, LooksAreOfOneObjectOrOfAll) {
    Comparison& comparison = session_->comparison();
    const std::vector<ecs::Entity> gratings = comparison.gratings();
    ASSERT_GE(gratings.size(), 2U);
    const std::string first = name_of_object(session_->play().world(), gratings[0]);
    set({Setting::RightLook, "spikes, fine", first});
    for (const ecs::Entity grating : gratings) {
        const bool meant = name_of_object(session_->play().world(), grating) == first;
        EXPECT_EQ(look_name(comparison.look(grating, Side::Right)), meant ? "spikes, fine" : "as cooked");
        EXPECT_EQ(look_name(comparison.look(grating, Side::Left)), "as cooked");
    }
    set({Setting::LeftLook, "spikes, coarse"});
    int changed = 0;
    for (const ecs::Entity grating : gratings) {
        const bool suits = apply_look(comparison.subject(grating), *parse_look("spikes, coarse")).has_value();
        EXPECT_EQ(look_name(comparison.look(grating, Side::Left)), suits ? "spikes, coarse" : "as cooked");
        changed += suits ? 1 : 0;
    }
    EXPECT_GT(changed, 1);
    const Look before = comparison.look(gratings[0], Side::Left);
    set({Setting::LeftLook, "sparkles"});
    EXPECT_EQ(comparison.look(gratings[0], Side::Left), before);
}

}  // namespace
}  // namespace rowland::demo
