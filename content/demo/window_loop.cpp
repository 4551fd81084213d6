#include "content/demo/window_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "content/demo/assets.h"
#include "content/demo/demo_scene.h"
#include "content/demo/open_picture.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gpu/debug.h"
#include "engine/platform/frame_pacing.h"
#include "engine/platform/input.h"
#include "engine/platform/window.h"
#include "engine/scene/fly_camera.h"
#include "engine/scene/orbit_camera.h"
#include "engine/view/capture.h"
#include "engine/view/picture.h"

namespace rowland::demo {

const char* const kWindowHelp =
    "In the window: drag to orbit, wheel to zoom; C flies (WASD QE, mouse, Shift and Ctrl for speed; C or Esc ends "
    "it);\n"
    "Space pauses, P next probe, V next view, L lamp with shadow, - and = exposure, 1 bloom, 2 vignette, 3 automatic\n"
    "exposure, 4 dither; F5 reloads shaders and assets, F9 scene-linear EXR, F11 full screen, F12\n"
    "screenshot, Esc ends. Drop a probe onto the window to light the scene by it. Shaders, assets and their sources "
    "are\n"
    "followed: save a file and see it; if it is broken the picture stays and the title says why.";

namespace {

using platform::Key;

constexpr float kExposureStep = 0.25F;
constexpr int kFramesBetweenShaderLooks = 10;

enum class Screenshot { None, Display, Linear };

class WindowLoop {
 public:
    WindowLoop(const Options& options, const post::OcioConfig& config)
        : options_(options),
          config_(config),
          window_({.title = "Rowland", .size = {options.width, options.height}}),
          picture_(open_picture(options, config, window_.framebuffer_size(), Pace::Fluent)),
          assets_(options, picture_->renderer().gltf_extensions()),
          scene_(options, assets_, picture_->renderer(), picture_->xyz_to_working()),
          shaders_(picture_->shader_sources(options.shader_folder)),
          orbit_(scene_.camera()),
          fly_(scene_.camera()),
          probe_paths_(probe_paths(options)),
          views_(config.views(config.default_display())) {
        gpu::enable_debug_output(false);
        use_probe(probe_paths_[0]);
        view_ = options.view.empty() ? config.default_view(config.default_display()) : options.view;
        window_.set_drop_handler([this](const std::vector<std::filesystem::path>& files) { drop(files); });
    }

    void run() {
        while (!window_.should_close()) {
            const std::chrono::nanoseconds elapsed = clock_.tick();
            times_.add(elapsed);
            const double seconds = std::chrono::duration<double>(elapsed).count();
            window_.poll(input_);
            handle_keys();
            if (options_.watch) follow_files();
            move_camera(seconds);
            if (!paused_) {
                pace_.advance(elapsed);
                scene_.advance_to(pace_.simulated_s() + pace_.alpha() * pace_.step_s());
            }
            const glm::ivec2 size = window_.framebuffer_size();
            if (size.x < 1 || size.y < 1) {  // minimised: nothing to draw, and no display to wait for
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
                continue;
            }
            picture_->resize(size);
            picture_->draw(scene_.world(), flying_ ? fly_.camera() : orbit_.camera(), static_cast<float>(seconds));
            if (screenshot_wanted_ != Screenshot::None) take_screenshot();
            picture_->encoded().show_in_window();
            window_.swap();
            show_title(seconds);
        }
    }

 private:
    bool pressed(Key key) const { return input_.key(key).pressed; }

    /// Runs something that bad input may refuse; the demo goes on as it was.
    template <typename F>
    void attempt(F&& action) {
        try {
            action();
        } catch (const Error& error) {
            log_error("{}", error.what());
        }
    }

    void handle_keys() {
        if (pressed(Key::Escape) && !flying_) window_.request_close();
        if (pressed(Key::C) || (pressed(Key::Escape) && flying_)) toggle_flying();
        if (pressed(Key::Space)) paused_ = !paused_;
        if (pressed(Key::P)) attempt([&] { next_probe(); });
        if (pressed(Key::V)) attempt([&] { next_view(); });
        if (pressed(Key::L)) scene_.set_sun(!scene_.sun());
        if (pressed(Key::F5)) {
            reload_shaders();
            assets_.reload_all();
        }
        if (pressed(Key::F11)) window_.set_fullscreen(!window_.fullscreen());
        if (pressed(Key::F9)) screenshot_wanted_ = Screenshot::Linear;
        if (pressed(Key::F12)) screenshot_wanted_ = Screenshot::Display;
        post::PostSettings& post = picture_->post_settings();
        if (pressed(Key::Minus)) post.exposure_stops -= kExposureStep;
        if (pressed(Key::Equal)) post.exposure_stops += kExposureStep;
        const auto toggle = [this](Key key, auto& effect, const auto& settings) {
            if (!pressed(key)) return;
            if (effect)
                effect.reset();
            else
                effect = settings;
        };
        toggle(Key::Digit1, post.bloom, post::BloomSettings{});
        toggle(Key::Digit2, post.vignette, post::VignetteSettings{.vertical_fov = kFieldOfView, .strength = 0.5F});
        toggle(Key::Digit3, post.auto_exposure, post::AutoExposureSettings{});
        toggle(Key::Digit4, post.dither, post::DitherSettings{});
    }

    void toggle_flying() {
        flying_ = !flying_;
        if (flying_) fly_ = scene::FlyCamera(orbit_.camera(), {.speed_m_per_s = 0.2F});
        window_.set_cursor_captured(flying_);
    }

    void move_camera(double seconds) {
        if (!flying_) {
            orbit_.update({.drag = glm::vec2(input_.mouse_drag(platform::MouseButton::Left)) + pad_drag(seconds),
                           .scroll = static_cast<float>(input_.scroll().y)});
            return;
        }
        const glm::vec2 stick = input_.left_stick();
        fly_.update({.move = {input_.key_axis(Key::A, Key::D) + stick.x, input_.key_axis(Key::Q, Key::E),
                              input_.key_axis(Key::S, Key::W) + stick.y},
                     .look = glm::vec2(input_.mouse_delta()),
                     .turn = input_.right_stick(),
                     .fast = input_.key(Key::LeftShift).down,
                     .slow = input_.key(Key::LeftControl).down},
                    seconds);
    }

    /// The game pad's right stick, as the drag of a mouse.
    glm::vec2 pad_drag(double seconds) const {
        constexpr float kPixelsPerSecond = 400.0F;
        return glm::vec2(-input_.right_stick().x, input_.right_stick().y) * kPixelsPerSecond *
               static_cast<float>(seconds);
    }

    void next_probe() {
        use_probe(probe_paths_[(probe_index_ + 1) % probe_paths_.size()]);
        probe_index_ = (probe_index_ + 1) % probe_paths_.size();
    }

    void use_probe(const std::filesystem::path& path) {
        probe_ = assets_.probe(path);
        picture_->set_probe(*probe_);
        probe_version_ = probe_.version();
    }

    void follow_files() {
        if (assets_.poll()) scene_.refresh();
        if (probe_version_ != probe_.version()) {
            picture_->set_probe(*probe_);
            probe_version_ = probe_.version();
        }
        shader_age_ += 1;
        if (shader_age_ % kFramesBetweenShaderLooks == 0 && shaders_.changed()) reload_shaders();
    }

    void next_view() {
        const auto at = std::find(views_.begin(), views_.end(), view_);
        view_ = at == views_.end() || at + 1 == views_.end() ? views_.front() : *(at + 1);
        picture_->set_view(config_, view_);
        log_info("view {}", view_);
    }

    void reload_shaders() {
        shader_failure_.clear();
        try {
            picture_->reload_shaders(options_.shader_folder);
            log_info("shaders reloaded from {}", options_.shader_folder.string());
        } catch (const Error& error) {
            shader_failure_ = error.what();
            log_error("{}", shader_failure_);
        }
    }

    /// Why something on the screen is not what its file says; empty if all is well.
    std::string failure() const {
        if (!shader_failure_.empty()) return shader_failure_;
        if (const auto failures = assets_.failures(); !failures.empty()) return failures.front();
        return scene_.failures().empty() ? std::string() : scene_.failures().front();
    }

    void drop(const std::vector<std::filesystem::path>& files) {
        attempt([&] {
            if (!files.empty()) use_probe(files.front());
        });
    }

    void take_screenshot() {
        const bool linear = screenshot_wanted_ == Screenshot::Linear;
        screenshot_wanted_ = Screenshot::None;
        const std::filesystem::path path =
            options_.output_folder / fmt::format("screenshot_{:04}.{}", screenshots_taken_++, linear ? "exr" : "png");
        attempt([&] {
            if (linear)
                view::write_linear_capture(picture_->linear(), path);
            else
                view::write_display_capture(picture_->encoded(), path);
            log_info("wrote {}", path.string());
        });
    }

    void show_title(double seconds) {
        constexpr double kTitleInterval_s = 0.5;
        title_age_s_ += seconds;
        if (title_age_s_ < kTitleInterval_s) return;
        title_age_s_ = 0.0;
        if (const std::string why = failure(); !why.empty()) {
            window_.set_title("Rowland: " + why);
            return;
        }
        const platform::FrameStatistics statistics = times_.statistics();
        window_.set_title(fmt::format("Rowland: {:.1f} ms a frame, {}, {:+.2f} stops", statistics.median_ms, view_,
                                      picture_->post_settings().exposure_stops));
    }

    const Options& options_;
    const post::OcioConfig& config_;
    platform::Window window_;
    std::unique_ptr<view::Picture> picture_;
    Assets assets_;
    DemoScene scene_;
    asset::FileWatch shaders_;
    std::string shader_failure_;
    int shader_age_ = 0;
    scene::OrbitCamera orbit_;
    scene::FlyCamera fly_;
    std::vector<std::filesystem::path> probe_paths_;
    std::size_t probe_index_ = 0;
    asset::Handle<lighting::LightProbe> probe_;
    std::uint64_t probe_version_ = 0;
    std::vector<std::string> views_;
    std::string view_;
    platform::InputState input_;
    platform::FrameClock clock_;
    platform::FrameTimes times_;
    platform::FixedStep pace_;
    double title_age_s_ = 0.0;
    int screenshots_taken_ = 0;
    bool flying_ = false;
    bool paused_ = false;
    Screenshot screenshot_wanted_ = Screenshot::None;
};

}  // namespace

void run_in_window(const Options& options, const post::OcioConfig& config) {
    WindowLoop(options, config).run();
}

}  // namespace rowland::demo
