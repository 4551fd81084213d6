#include "content/demo/offscreen.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "content/demo/assets.h"
#include "content/demo/benchmark.h"
#include "content/demo/camera_path.h"
#include "content/demo/play/play_clock.h"
#include "content/demo/replay.h"
#include "content/demo/session.h"
#include "engine/app/context.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/outputs.h"
#include "engine/core/progress.h"
#include "engine/view/capture.h"

namespace rowland::demo {

namespace {

constexpr int kBenchmarkFrames = 300;
constexpr int kTourFrames = 12;
constexpr int kTourFramesPerSecond = 2;
constexpr std::size_t kTourProbes = 4;

void pass_time(Play& play, int frames_per_second) {
    for (int i = 0; i < kStepsPerSecond / frames_per_second; ++i) play.step({});
}

/// The captures of the last frame, the `frame`-th of `frames`.
void write_captures_of(Session& session, const Options& options, int frame, int frames) {
    if (options.capture_linear)
        view::write_linear_capture(session.picture().linear(), view::numbered(*options.capture_linear, frame, frames));
    if (options.capture)
        view::write_display_capture(session.picture().encoded(), view::numbered(*options.capture, frame, frames));
}

void write_captures(Session& session, const Options& options) {
    const int frames = options.frames.value_or(1);
    for (int frame = 0; frame < frames; ++frame) {
        if (frame > 0) pass_time(session.play(), kFramesPerSecond);
        session.draw(1.0F / kFramesPerSecond);
        write_captures_of(session, options, frame, frames);
    }
}

/// A flight through the scene's views as numbered PNG files. Each probe lights an equal part of it.
void write_tour(Session& session, const Options& options) {
    std::vector<std::filesystem::path> probes = probe_paths(options);
    probes.resize(std::min(probes.size(), kTourProbes));
    const std::vector<scene::Camera> views = session.scene().views();
    const int frames = options.frames.value_or(kTourFrames);
    Progress progress("pictures", static_cast<std::size_t>(frames));
    for (int frame = 0; frame < frames; ++frame) {
        const auto& probe = probes[static_cast<std::size_t>(frame) * probes.size() / static_cast<std::size_t>(frames)];
        if (probe != session.probe_path()) session.use_probe(probe);
        if (frame > 0) pass_time(session.play(), kTourFramesPerSecond);
        const scene::Camera camera = tour(views, frames > 1 ? static_cast<double>(frame) / (frames - 1) : 0.0);
        session.draw_from(camera, 1.0F / kTourFramesPerSecond);
        const std::string name = fmt::format("flight_{:02}_{}.png", frame, probe.stem().string());
        view::write_display_capture(session.picture().encoded(), options.output_folder / name);
        progress.advance();
    }
}

/// In frames of 1/30 s, at most as many as the options say. Without captures, the last picture goes to the output
/// folder.
void play_back(Session& session, const Options& options, const Recording& recording) {
    // A little long, so that rounding never leaves a frame a step short.
    constexpr std::chrono::nanoseconds kFrame(1'000'000'000 / kFramesPerSecond + 1);
    constexpr std::uint64_t kStepsPerFrame = kStepsPerSecond / kFramesPerSecond;
    std::uint64_t frames = (recording.step_count + kStepsPerFrame - 1) / kStepsPerFrame;
    if (options.frames) frames = std::min(frames, static_cast<std::uint64_t>(*options.frames));
    PlayClock clock;
    Progress progress("frames", frames);
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
        clock.replay(session.play(), kFrame, recording);
        session.carry_out();
        session.draw(1.0F / kFramesPerSecond);
        write_captures_of(session, options, static_cast<int>(frame), static_cast<int>(frames));
        progress.advance();
    }
    if (!options.captures() && frames > 0)
        view::write_display_capture(session.picture().encoded(), options.output_folder / "play.png");
    log_state(session.play());
}

}  // namespace

void run_offscreen(const Options& options, const post::OcioConfig& config) {
    const bool writes_to_folder = !options.captures() && !options.benchmark;
    if (writes_to_folder) rowland::check_outputs({}, {{{"--output-folder", options.output_folder / "flight.png"}}});
    app::render_offscreen(options.gl_debug, [&](const std::string& renderer) {
        const std::optional<Recording> recording = recording_for(options);
        const glm::ivec2 size(options.width, options.height);
        Session session(options, config, size, recording ? recording->head.window : size,
                        options.benchmark || recording ? Pace::Fluent : Pace::Still);
        // A picture in a file depends on nothing but what it shows.
        session.picture().post_settings().wait_for_exposure = !options.benchmark;
        if (options.benchmark) {
            session.picture().time_passes(true);
            const auto times = fly_around(session, options.frames.value_or(kBenchmarkFrames), renderer);
            write_file_atomic(*options.benchmark, times.dump(2) + "\n");
            log_info("wrote {}", options.benchmark->string());
        } else if (recording) {
            play_back(session, options, *recording);
        } else if (options.captures()) {
            write_captures(session, options);
        } else {
            write_tour(session, options);
        }
    });
}

}  // namespace rowland::demo
