#include "content/demo/window_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "content/demo/hud/hud.h"
#include "content/demo/play/fingerprint.h"
#include "content/demo/play/play_clock.h"
#include "content/demo/play/recording.h"
#include "content/demo/replay.h"
#include "content/demo/session.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gpu/debug.h"
#include "engine/platform/frame_pacing.h"
#include "engine/platform/window.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::demo {

namespace {

/// The window's own events of a frame, for the play.
std::vector<PlayEvent> events_of(platform::Window& window, glm::ivec2& known_size) {
    std::vector<PlayEvent> events;
    if (const glm::ivec2 size = window.size(); size != known_size && size.x >= 1 && size.y >= 1) {
        known_size = size;
        events.emplace_back(ResizeEvent{size});
    }
    for (const platform::InputEvent& event : window.poll_events()) events.emplace_back(event);
    return events;
}

bool is_escape(const PlayEvent& event) {
    const auto* input = std::get_if<platform::InputEvent>(&event);
    const auto* key = input == nullptr ? nullptr : std::get_if<platform::KeyEvent>(input);
    return key != nullptr && key->down && key->key == platform::Key::Escape;
}

class WindowLoop {
 public:
    WindowLoop(const Options& options, const post::OcioConfig& config)
        : options_(options),
          recording_(options.play ? std::optional(recording_for(options)) : std::nullopt),
          window_({.title = "Rowland",
                   .size = recording_ ? recording_->head.window : glm::ivec2(options.width, options.height)}),
          window_size_(window_.size()),
          session_(options, config, window_.framebuffer_size(), recording_ ? recording_->head.window : window_size_,
                   Pace::Fluent),
          hud_(options, session_, window_size_, window_.content_scale().x) {
        gpu::enable_debug_output(false);
        if (options.record)
            recorder_.emplace(*options.record, RecordingHead{.scene = scene_name(options), .window = window_size_});
        window_.set_drop_handler([this](const std::vector<std::filesystem::path>& files) { drop(files); });
    }

    void run() {
        while (!window_.should_close() && (!options_.frames || frames_ < *options_.frames)) {
            frame();
            ++frames_;
        }
        if (recorder_) recorder_->finish(session_.play().steps());
        if (recorder_ || recording_) tell_state();
    }

 private:
    void frame() {
        const std::chrono::nanoseconds elapsed = clock_.tick();
        times_.add(elapsed);
        const double seconds = std::chrono::duration<double>(elapsed).count();
        advance(elapsed, seconds);
        for (const Action action : session_.carry_out()) perform(action);
        if (replay_over_) hand_over();
        window_.set_cursor_captured(session_.play().walking());
        if (options_.watch) session_.follow_files();
        const glm::ivec2 size = window_.framebuffer_size();
        if (size.x < 1 || size.y < 1) {  // minimised: nothing to draw, and no display to wait for
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            return;
        }
        session_.picture().resize(size);
        session_.draw(static_cast<float>(seconds));
        session_.picture().encoded().show_in_window();
        hud_.build();
        hud_.draw_in_window();
        window_.swap();
        show_title(seconds);
    }

    void advance(std::chrono::nanoseconds elapsed, double seconds) {
        std::vector<PlayEvent> events = events_of(window_, window_size_);
        if (const auto dropped = std::exchange(dropped_, std::nullopt)) events.emplace_back(*dropped);
        events = hud_.begin_frame(
            std::move(events),
            {.size = window_size_, .framebuffer_size = window_.framebuffer_size(), .seconds = seconds});
        if (!recording_) {
            play_clock_.live(session_.play(), elapsed, std::move(events), recorder_ ? &*recorder_ : nullptr);
            return;
        }
        replay_over_ = !play_clock_.replay(session_.play(), elapsed, *recording_) ||
                       std::any_of(events.begin(), events.end(), is_escape);
    }

    /// The recording is over, or the user has seen enough of it: from now on the play is his.
    void hand_over() {
        tell_state();
        recording_.reset();
        replay_over_ = false;
        if (closed_in_recording_) window_.request_close();
        // Keys that the recording left down are up.
        play_clock_.live(session_.play(), {},
                         {platform::InputEvent(platform::FocusEvent{false}),
                          platform::InputEvent(platform::FocusEvent{true}), ResizeEvent{window_size_}},
                         nullptr);
    }

    void tell_state() { log_info("played {} steps, state {}", session_.play().steps(), fingerprint(session_.play())); }

    void perform(Action action) {
        if (hud_.perform(action)) return;
        if (action == Action::Close) close();
        if (action == Action::FullScreen) window_.set_fullscreen(!window_.fullscreen());
    }

    /// A recording plays to its end, whenever in its last frame it was closed.
    void close() {
        if (recording_)
            closed_in_recording_ = true;
        else
            window_.request_close();
    }

    void drop(const std::vector<std::filesystem::path>& files) {
        if (!files.empty()) dropped_ = SettingEvent{Setting::Probe, files.front().string()};
    }

    void show_title(double seconds) {
        constexpr double kTitleInterval_s = 0.5;
        title_age_s_ += seconds;
        if (title_age_s_ < kTitleInterval_s) return;
        title_age_s_ = 0.0;
        if (const std::string why = session_.failure(); !why.empty()) {
            window_.set_title("Rowland: " + why);
            return;
        }
        Play& play = session_.play();
        window_.set_title(fmt::format(
            "Rowland: {:.1f} ms a frame, {}, {:+.2f} stops, {} lights{}{}", times_.statistics().median_ms,
            session_.view(), session_.picture().post_settings().exposure_stops, light_count(play.world()),
            play.paused() ? ", paused" : "", diffraction::maps_are_filling(play.world()) ? ", filling maps" : ""));
    }

    const Options& options_;
    std::optional<Recording> recording_;  ///< until it is over
    bool replay_over_ = false;
    bool closed_in_recording_ = false;
    std::optional<Recorder> recorder_;
    std::optional<SettingEvent> dropped_;  ///< onto the window since the last frame
    platform::Window window_;
    glm::ivec2 window_size_;
    Session session_;
    Hud hud_;
    PlayClock play_clock_;
    platform::FrameClock clock_;
    platform::FrameTimes times_;
    double title_age_s_ = 0.0;
    int frames_ = 0;
};

}  // namespace

void run_in_window(const Options& options, const post::OcioConfig& config) {
    WindowLoop(options, config).run();
}

}  // namespace rowland::demo
