#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content/demo/assets.h"
#include "content/demo/demo_scene.h"
#include "content/demo/looks/comparison.h"
#include "content/demo/options.h"
#include "content/demo/play/play.h"
#include "content/demo/play/recording.h"
#include "engine/asset/file_watch.h"
#include "engine/core/log.h"
#include "engine/post/ocio_config.h"
#include "engine/view/picture.h"
#include "modules/diffraction/runtime/frame_budget.h"
#include "modules/diffraction/runtime/map_cache.h"

namespace rowland::demo {

/// Whether maps may fill over several frames.
enum class Pace {
    Fluent,  ///< for a window: while an object turns, coarse maps follow it
    Still,   ///< for pictures: maps are full in every frame
};

/// The setting of a side's looks.
inline Setting look_setting(Side side) {
    return side == Side::Left ? Setting::LeftLook : Setting::RightLook;
}

/// A running demo, in a window or without one: the scene, what the player does with it, its picture, and the files
/// that it is made of.
class Session {
 public:
    /// `pixels`: size of the picture; `window`: size in the mouse's units; `map_wait`: see DiffractionSettings.
    /// `options` and `config` must outlive it. Throws Error (input).
    Session(const Options& options, const post::OcioConfig& config, glm::ivec2 pixels, glm::ivec2 window, Pace pace,
            std::chrono::milliseconds map_wait = diffraction::kMapWait);

    Play& play() { return play_; }
    DemoScene& scene() { return scene_; }
    view::Picture& picture() { return *picture_; }
    Comparison& comparison() { return comparison_; }
    const lighting::LightProbe& probe() const { return *probe_; }
    /// Grows with every change of the probe.
    std::uint64_t probe_version() const { return probe_changes_; }
    const std::filesystem::path& probe_path() const { return probe_path_; }
    const std::string& view() const { return view_; }
    const std::vector<std::string>& views() const { return views_; }
    /// Name of the sheet that one looks through; empty: none.
    std::string sheet() const { return sheet_ == 0 ? std::string() : sheets_[sheet_ - 1].name; }

    /// Lights the scene with another probe. Throws Error (input) and keeps the old one.
    void use_probe(const std::filesystem::path& path);

    /// Carries out the play's commands, and returns the actions that a session does not know. Bad input is logged and
    /// changes nothing.
    std::vector<Action> carry_out();
    /// What the budget has chosen since the last call, as events for a recording.
    std::vector<PlayEvent> take_chosen_rungs();
    /// From now on budgets choose by what is measured, not as the recording tells.
    void end_playback();
    /// Reloads files that have changed.
    void follow_files();
    /// Draws the world as the play has it, `seconds` after the last frame, then takes the screenshots asked for.
    void draw(float seconds);
    /// Draws the world through another camera, without screenshots.
    void draw_from(const scene::Camera& camera, float seconds);
    /// What the user is told, newest last.
    const std::vector<Message>& messages() const { return messages_.all(); }
    /// Null: there is no budget, or no frame since it was set.
    const diffraction::FrameBudgetReport* budget_report() {
        return scene_.world().find<diffraction::FrameBudgetReport>(budget_);
    }
    /// The budget for all gratings of a frame; 0: none.
    double gratings_ms() {
        const auto* budget = scene_.world().find<diffraction::FrameBudget>(budget_);
        return budget != nullptr ? budget->gratings_ms : 0.0;
    }
    /// Why the picture does not show a file's present content; empty if it does.
    std::string failure() const;

 private:
    void set(const SettingEvent& setting);
    bool perform(Action action);
    /// 0: no budget.
    void set_budget(double gratings_ms);
    void use_view(const std::string& view);
    void look_through(std::size_t sheet);
    void set_look(Side side, const std::string& object, const std::string& look);
    void show_probe();
    ecs::Entity grating_numbered(const std::string& text);
    std::filesystem::path probe_named(const std::string& name) const;
    void reload_shaders();
    void refresh_scene();
    void write_screenshot(bool linear);

    Messages messages_;
    const Options& options_;
    const post::OcioConfig& config_;
    std::unique_ptr<view::Picture> picture_;
    LiveAssets assets_;
    DemoScene scene_;
    Play play_;
    Comparison comparison_;
    asset::FileWatch shaders_;
    std::string shader_failure_;
    std::string shown_failure_;  ///< failure(), as it was told last
    int frames_followed_ = 0;
    std::vector<std::filesystem::path> probe_paths_;
    std::filesystem::path probe_path_;
    asset::Handle<lighting::LightProbe> probe_;
    std::uint64_t probe_version_ = 0;
    std::uint64_t probe_changes_ = 0;
    std::vector<std::string> views_;
    std::string view_;
    std::vector<Sheet> sheets_;
    std::size_t sheet_ = 0;  ///< one more than the index of the one looked through; 0: none
    std::vector<Action> screenshots_;
    ecs::Entity budget_;  ///< has the FrameBudget; not alive without a budget
    bool plays_back_;     ///< a recording tells the rungs
    std::vector<std::optional<std::size_t>>
        told_rungs_;  ///< by take_chosen_rungs(), of each grating since set_budget()
};

/// What the options show, by the name that a recording stores.
std::string scene_name(const Options& options);

/// The recording that the options name, if they name one. Throws Error (input) if it is damaged or was made with
/// another scene.
std::optional<Recording> recording_for(const Options& options);

/// Logs the step count and fingerprint of a play. A recording and its playback end with the same line.
void log_state(const Play& play);

}  // namespace rowland::demo
