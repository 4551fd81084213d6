#include "content/demo/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "content/demo/hud/hud.h"
#include "content/demo/play/recording.h"
#include "content/demo/session.h"
#include "engine/app/window_loop.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::demo {

namespace {

bool is_escape(const PlayEvent& event) {
    const auto* input = std::get_if<platform::InputEvent>(&event);
    const auto* key = input == nullptr ? nullptr : std::get_if<platform::KeyEvent>(input);
    return key != nullptr && key->down && key->key == platform::Key::Escape;
}

class Program {
 public:
    Program(const Options& options, const post::OcioConfig& config)
        : options_(options),
          recording_(recording_for(options)),
          loop_("Rowland", recording_ ? recording_->head.window : glm::ivec2(options.width, options.height),
                options.gl_debug),
          window_size_(loop_.window().size()),
          session_(options, config, loop_.window().framebuffer_size(),
                   recording_ ? recording_->head.window : window_size_, Pace::Fluent),
          hud_(options, session_, loop_.times(), window_size_, loop_.window().content_scale().x),
          one_core_for_frames_(std::max(1U, std::thread::hardware_concurrency() - 1)) {
        if (options.record)
            recorder_.emplace(*options.record, RecordingHead{.scene = scene_name(options), .window = window_size_});
    }

    void run() {
        loop_.run([this](const app::Frame& frame) { return update(frame); },
                  [this](const app::Frame& frame) { draw(frame); });
        if (recorder_) recorder_->finish(session_.play().steps());
        if (recorder_ || recording_) log_state(session_.play());
    }

 private:
    app::Next update(const app::Frame& frame) {
        if (loop_.window().should_close() || (options_.frames && frames_++ == *options_.frames)) return app::Next::End;
        const bool recording_goes_on = advance(frame);
        for (const Action action : session_.carry_out()) perform(action);
        if (!recording_goes_on) hand_over();
        loop_.window().set_cursor_captured(session_.play().walking());
        if (options_.watch) session_.follow_files();
        return app::Next::Frame;
    }

    void draw(const app::Frame& frame) {
        session_.picture().resize(frame.pixels);
        session_.draw(static_cast<float>(frame.seconds()));
        session_.picture().encoded().show_in_window();
        hud_.build();
        hud_.draw_in_window();
        show_title(frame.seconds());
    }

    /// False if a recording was played back and is over.
    bool advance(const app::Frame& frame) {
        std::vector<PlayEvent> events;
        if (frame.size != window_size_ && frame.size.x >= 1 && frame.size.y >= 1) {
            window_size_ = frame.size;
            events.emplace_back(ResizeEvent{frame.size});
        }
        events.insert(events.end(), frame.events.begin(), frame.events.end());
        if (!frame.dropped.empty()) hud_.use_probe(frame.dropped.front());
        events = hud_.begin_frame(std::move(events),
                                  {.size = window_size_, .framebuffer_size = frame.pixels, .seconds = frame.seconds()});
        if (recording_)
            return play_clock_.replay(session_.play(), frame.elapsed, *recording_) &&
                   std::ranges::none_of(events, is_escape);
        if (recorder_) {
            const std::vector<PlayEvent> rungs = session_.take_chosen_rungs();
            events.insert(events.end(), rungs.begin(), rungs.end());
        }
        play_clock_.live(session_.play(), frame.elapsed, std::move(events), recorder_ ? &*recorder_ : nullptr);
        return true;
    }

    /// The recording is over, or the user has ended it: from now on the user plays.
    void hand_over() {
        log_state(session_.play());
        recording_.reset();
        session_.end_playback();
        if (closed_in_recording_) loop_.window().request_close();
        // Releases the keys that the recording left down.
        play_clock_.live(session_.play(), {},
                         {platform::InputEvent(platform::FocusEvent{false}),
                          platform::InputEvent(platform::FocusEvent{true}), ResizeEvent{window_size_}},
                         nullptr);
    }

    void perform(Action action) {
        if (hud_.perform(action)) return;
        if (action == Action::FullScreen) loop_.window().set_fullscreen(!loop_.window().fullscreen());
        if (action != Action::Close) return;
        // A recording plays to its end, in whichever of its frames the window was closed.
        closed_in_recording_ = recording_.has_value();
        if (!recording_) loop_.window().request_close();
    }

    void show_title(double seconds) {
        constexpr double kTitleInterval_s = 0.5;
        title_age_s_ += seconds;
        if (title_age_s_ < kTitleInterval_s) return;
        title_age_s_ = 0.0;
        if (const std::string why = session_.failure(); !why.empty()) {
            loop_.window().set_title("Rowland: " + why);
            return;
        }
        Play& play = session_.play();
        loop_.window().set_title(fmt::format(
            "Rowland: {:.1f} ms a frame, {}, {:+.2f} stops, {} lights{}{}", loop_.times().statistics().median_ms,
            session_.view(), session_.picture().post_settings().exposure_stops, light_count(play.world()),
            play.paused() ? ", paused" : "", diffraction::maps_are_filling(play.world()) ? ", filling maps" : ""));
    }

    const Options& options_;
    std::optional<Recording> recording_;  ///< while it is played back
    bool closed_in_recording_ = false;
    std::optional<Recorder> recorder_;
    app::WindowLoop loop_;
    glm::ivec2 window_size_;
    Session session_;
    Hud hud_;
    ThreadLimit one_core_for_frames_;  ///< only from here on, so that loading uses all cores
    PlayClock play_clock_;
    double title_age_s_ = 0.0;
    int frames_ = 0;
};

}  // namespace

void run_in_window(const Options& options, const post::OcioConfig& config) {
    Program(options, config).run();
}

}  // namespace rowland::demo
