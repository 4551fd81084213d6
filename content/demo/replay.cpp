#include "content/demo/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "content/demo/play/fingerprint.h"
#include "content/demo/play/play_clock.h"
#include "content/demo/stills.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/progress.h"
#include "engine/core/utf8.h"
#include "engine/view/capture.h"

namespace rowland::demo {

namespace {

// A little long, so that rounding never leaves a frame a step short.
constexpr std::chrono::nanoseconds kFrame(1'000'000'000 / kFramesPerSecond + 1);

std::uint64_t frames_of(const Recording& recording, const Options& options) {
    constexpr std::uint64_t kStepsPerFrame = kStepsPerSecond / kFramesPerSecond;
    const std::uint64_t all = (recording.step_count + kStepsPerFrame - 1) / kStepsPerFrame;
    return options.frames ? std::min(all, static_cast<std::uint64_t>(*options.frames)) : all;
}

}  // namespace

std::string scene_name(const Options& options) {
    const auto& file = options.scene ? options.scene : options.mesh;
    return file ? valid_utf8(file->filename().string()) : "disc";
}

Recording recording_for(const Options& options) {
    Recording recording = load_recording(*options.play);
    if (const std::string shown = scene_name(options); recording.head.scene != shown)
        refuse_input(options.play->string(), "line 1", fmt::format("a play with the scene {}", recording.head.scene),
                     fmt::format("one with {}", shown), "name that scene with --scene, --mesh or --disc");
    return recording;
}

void play_back(Session& session, const Options& options, const Recording& recording) {
    const std::uint64_t frames = frames_of(recording, options);
    PlayClock clock;
    Progress progress("frames", frames);
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
        clock.replay(session.play(), kFrame, recording);
        session.carry_out();
        session.draw(1.0F / kFramesPerSecond);
        write_captures_of(session, options, static_cast<int>(frame), static_cast<int>(frames));
        progress.advance();
    }
    if (!names_a_capture(options) && frames > 0) {
        const auto path = options.output_folder / "play.png";
        view::write_display_capture(session.picture().encoded(), path);
        log_info("wrote {}", path.string());
    }
    log_info("played {} steps, state {}", session.play().steps(), fingerprint(session.play()));
}

}  // namespace rowland::demo
