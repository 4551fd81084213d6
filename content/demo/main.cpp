#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

#include "content/demo/assets.h"
#include "content/demo/benchmark.h"
#include "content/demo/options.h"
#include "content/demo/replay.h"
#include "content/demo/session.h"
#include "content/demo/stills.h"
#include "content/demo/window_loop.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/program.h"
#include "engine/gpu/debug.h"
#include "engine/platform/headless_context.h"
#include "engine/platform/window.h"

namespace rowland::demo {
namespace {

constexpr int kBenchmarkFrames = 300;

bool needs_a_window(const Options& options) {
    return !options.headless && !options.benchmark && !names_a_capture(options) && platform::display_available();
}

/// Without a window there is nobody to record.
void refuse_to_record(const Options& options) {
    if (options.record)
        refuse_input("--record", {}, "no window to play in", "a display, and neither --headless nor captures",
                     "leave --record out");
}

void run_headless(const Options& options, const post::OcioConfig& config) {
    const platform::HeadlessContext context;
    gpu::enable_debug_output(false);
    log_info("rendering on {}", context.renderer());
    const auto started = std::chrono::steady_clock::now();
    const glm::ivec2 size(options.width, options.height);
    const std::optional<Recording> recording = options.play ? std::optional(recording_for(options)) : std::nullopt;
    Session session(options, config, size, recording ? recording->head.window : size,
                    options.benchmark || recording ? Pace::Fluent : Pace::Still);
    if (options.benchmark) {
        write_benchmark(*options.benchmark, fly_around(session, options.frames.value_or(kBenchmarkFrames)),
                        context.renderer());
        log_info("wrote {}", options.benchmark->string());
        return;
    }
    if (recording)
        play_back(session, options, *recording);
    else if (names_a_capture(options))
        write_captures(session, options);
    else
        write_tour(session, options);
    log_info("done in {:.1f} s", std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count());
}

int run(int argc, char** argv) {
    std::optional<Options> options = parse_options(argc, argv);
    if (!options) return 0;
    if (options->cooked_folder.empty()) options->cooked_folder = default_cooked_folder();
    if (!options->scene && !options->mesh && !options->material && !options->disc)
        options->scene = options->cooked_folder / "cabinet.glb";
    const post::OcioConfig config = post::OcioConfig::choose(options->ocio_config);
    if (options->list_views) {
        for (const std::string& view : config.views(config.default_display())) std::puts(view.c_str());
    } else if (needs_a_window(*options)) {
        run_in_window(*options, config);
    } else {
        refuse_to_record(*options);
        options->watch = false;
        run_headless(*options, config);
    }
    return 0;
}

}  // namespace
}  // namespace rowland::demo

int main(int argc, char** argv) {
    return rowland::run_program([&] { return rowland::demo::run(argc, argv); });
}
