#include "content/demo/stills.h"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "content/demo/assets.h"
#include "content/demo/tour.h"
#include "engine/core/log.h"
#include "engine/core/progress.h"
#include "engine/view/capture.h"

namespace rowland::demo {

namespace {

constexpr int kTourFrames = 12;
constexpr int kTourFramesPerSecond = 2;

void pass_time(Play& play, int frames_per_second) {
    for (int i = 0; i < kStepsPerSecond / frames_per_second; ++i) play.step({});
}

}  // namespace

bool names_a_capture(const Options& options) {
    return options.capture || options.capture_linear;
}

void write_captures_of(Session& session, const Options& options, int frame, int frames) {
    if (options.capture_linear) {
        const auto path = view::numbered(*options.capture_linear, frame, frames);
        view::write_linear_capture(session.picture().linear(), path);
        log_info("wrote {}", path.string());
    }
    if (options.capture) {
        const auto path = view::numbered(*options.capture, frame, frames);
        view::write_display_capture(session.picture().encoded(), path);
        log_info("wrote {}", path.string());
    }
}

void write_captures(Session& session, const Options& options) {
    const int frames = options.frames.value_or(1);
    for (int frame = 0; frame < frames; ++frame) {
        if (frame > 0) pass_time(session.play(), kFramesPerSecond);
        // Maps are filled for what has come to rest.
        if (frames == 1) session.draw(0.0F);
        session.draw(1.0F / kFramesPerSecond);
        write_captures_of(session, options, frame, frames);
    }
}

void write_tour(Session& session, const Options& options) {
    const std::vector<std::filesystem::path> probes = probe_paths(options);
    const std::vector<scene::Camera> views = session.scene().views();
    const int frames = options.frames.value_or(kTourFrames);
    std::size_t shown = 0;
    Progress progress("pictures", static_cast<std::size_t>(frames));
    for (int frame = 0; frame < frames; ++frame) {
        const std::size_t probe = static_cast<std::size_t>(frame) * probes.size() / static_cast<std::size_t>(frames);
        if (probe != shown) session.use_probe(probes[probe]);
        shown = probe;
        if (frame > 0) pass_time(session.play(), kTourFramesPerSecond);
        const double share = frames > 1 ? static_cast<double>(frame) / (frames - 1) : 0.0;
        const scene::Camera camera = tour(views, share);
        // Maps are filled for what has come to rest.
        session.draw_from(camera, 0.0F);
        session.draw_from(camera, 1.0F / kTourFramesPerSecond);
        const auto path =
            options.output_folder / fmt::format("flight_{:02}_{}.png", frame, probes[probe].stem().string());
        view::write_display_capture(session.picture().encoded(), path);
        log_info("wrote {}", path.string());
        progress.advance();
    }
}

}  // namespace rowland::demo
