#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "content/demo/assets.h"
#include "content/demo/demo_scene.h"
#include "content/demo/looks/comparison.h"
#include "content/demo/open_picture.h"
#include "content/demo/options.h"
#include "content/demo/play/play.h"
#include "engine/asset/file_watch.h"
#include "engine/post/ocio_config.h"
#include "engine/view/picture.h"

namespace rowland::demo {

/// The setting of a side's looks.
inline Setting look_setting(Side side) {
    return side == Side::Left ? Setting::LeftLook : Setting::RightLook;
}

/// A running demo, in a window or without one: the scene, what the player does with it, its picture and the files that
/// all come from.
class Session {
 public:
    /// `pixels`: of the picture; `window`: the mouse's units. Throws Error (input).
    Session(const Options& options, const post::OcioConfig& config, glm::ivec2 pixels, glm::ivec2 window, Pace pace);

    Play& play() { return play_; }
    DemoScene& scene() { return scene_; }
    view::Picture& picture() { return *picture_; }
    Comparison& comparison() { return comparison_; }
    LiveAssets& assets() { return assets_; }
    const lighting::LightProbe& probe() const { return *probe_; }
    /// Grows whenever the probe becomes another.
    std::uint64_t probe_version() const { return probe_changes_; }
    const std::filesystem::path& probe_path() const { return probe_path_; }
    const std::string& view() const { return view_; }

    /// Lights the scene by another probe. Throws Error (input), with the old one kept.
    void use_probe(const std::filesystem::path& path);
    /// Shows another view of the display. Throws Error (input).
    void use_view(const std::string& view);
    /// Does what a setting says. Throws Error (input) if there is no such probe, view or look.
    void set(const SettingEvent& setting);
    const std::vector<std::string>& views() const { return views_; }

    /// Carries out what the play left over, and hands back what is not for a session. What bad input refuses is logged
    /// and stays as it was.
    std::vector<Action> carry_out();
    /// Looks whether files changed, and takes them over.
    void follow_files();
    /// Draws the world as it stands, `seconds` after the last frame, then takes the screenshots that were asked for.
    void draw(float seconds);
    /// The same through another camera, for a picture beside the play.
    void draw_from(const scene::Camera& camera, float seconds);
    /// Why something in the picture is not what its file says; empty if all is well.
    std::string failure() const;

 private:
    bool perform(Action action);
    void next_probe();
    void next_view();
    std::filesystem::path probe_named(const std::string& name) const;
    void set_look(Side side, const std::string& object, const std::string& look);
    void reload_shaders();
    void take_over();
    void take_screenshots();
    void write_screenshot(bool linear);

    const Options& options_;
    const post::OcioConfig& config_;
    std::unique_ptr<view::Picture> picture_;
    LiveAssets assets_;
    DemoScene scene_;
    Play play_;
    Comparison comparison_;
    asset::FileWatch shaders_;
    std::string shader_failure_;
    int shader_age_ = 0;
    std::vector<std::filesystem::path> probe_paths_;
    std::size_t probe_index_ = 0;
    std::filesystem::path probe_path_;
    asset::Handle<lighting::LightProbe> probe_;
    std::uint64_t probe_version_ = 0;
    std::uint64_t probe_changes_ = 0;
    std::vector<std::string> views_;
    std::string view_;
    std::vector<Action> screenshots_;
    int screenshots_taken_ = 0;
};

}  // namespace rowland::demo
