#include "content/demo/replay.h"

#include <fmt/format.h>

#include "content/demo/play/play.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/utf8.h"

namespace rowland::demo {

std::string scene_name(const Options& options) {
    const auto& file = options.scene ? options.scene : options.mesh;
    return file ? valid_utf8(file->filename().string()) : "disc";
}

std::optional<Recording> recording_for(const Options& options) {
    if (!options.play) return std::nullopt;
    Recording recording = load_recording(*options.play);
    if (const std::string shown = scene_name(options); recording.head.scene != shown)
        refuse_input(options.play->string(), "line 1",
                     fmt::format("a recording with the scene {}", recording.head.scene),
                     fmt::format("one with {}", shown), "name that scene with --scene, --mesh or --disc");
    return recording;
}

void log_state(const Play& play) {
    log_info("played {} steps, state {}", play.steps(), play.fingerprint());
}

}  // namespace rowland::demo
