// What the user sets with sliders and lists, as the session carries it out.
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "content/demo/play/hierarchy.h"
#include "content/demo/session.h"
#include "engine/platform/headless_context.h"

namespace rowland::demo {
namespace {

class DemoSettings : public ::testing::Test {
 protected:
    DemoSettings() {
        options_.watch = false;
        options_.cooked_folder = std::filesystem::path(ROWLAND_DEMO).parent_path().parent_path() / "cooked";
        options_.scene = options_.cooked_folder / "cabinet.glb";
        session_.emplace(options_, config_, glm::ivec2(64, 36), glm::ivec2(64, 36), Pace::Fluent);
    }
    /// Through a step of the play, as from a panel or a recording.
    void set(const SettingEvent& event) {
        const std::vector<PlayEvent> events{event};
        session_->play().step(events);
        EXPECT_TRUE(session_->carry_out().empty());
    }
    const post::PostSettings& post() { return session_->picture().post_settings(); }

    platform::HeadlessContext context_;
    Options options_;
    post::OcioConfig config_ = post::OcioConfig::choose(std::nullopt);
    std::optional<Session> session_;
};

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
    set({Setting::Wipe, 1.0});
    set({Setting::WipeLine, 0.3});
    EXPECT_TRUE(session_->comparison().wiping());
    EXPECT_EQ(session_->comparison().line(), 0.3F);
    set({Setting::Wipe, 0.0});
    EXPECT_FALSE(session_->comparison().wiping());
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
        const bool suits = with_look(comparison.subject(grating), *look_named("spikes, coarse")).has_value();
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
