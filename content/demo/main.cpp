#include <chrono>
#include <cstdio>
#include <vector>

#include "content/demo/assets.h"
#include "content/demo/benchmark.h"
#include "content/demo/demo_scene.h"
#include "content/demo/open_picture.h"
#include "content/demo/options.h"
#include "content/demo/window_loop.h"
#include "engine/core/log.h"
#include "engine/core/program.h"
#include "engine/gpu/debug.h"
#include "engine/platform/headless_context.h"
#include "engine/platform/window.h"
#include "engine/view/capture.h"

namespace rowland::demo {
namespace {

constexpr double kSecondsPerFrame = 1.0 / 30.0;
constexpr int kBenchmarkFrames = 300;

/// A probe, and where its pictures go.
struct Job {
    std::filesystem::path probe;
    std::optional<std::filesystem::path> capture;
    std::optional<std::filesystem::path> capture_linear;
};

bool names_a_capture(const Options& options) {
    return options.capture || options.capture_linear;
}

bool needs_a_window(const Options& options) {
    return !options.headless && !options.benchmark && !names_a_capture(options) && platform::display_available();
}

std::vector<Job> jobs(const Options& options) {
    const std::vector<std::filesystem::path> probes = probe_paths(options);
    if (names_a_capture(options)) return {{probes[0], options.capture, options.capture_linear}};
    std::vector<Job> result;
    for (const std::filesystem::path& probe : probes)
        result.push_back({probe, options.output_folder / (probe.stem().string() + ".png"), std::nullopt});
    return result;
}

void run_job(const Job& job, const Options& options, view::Picture& picture, Assets& assets, DemoScene& scene) {
    picture.set_probe(*assets.probe(job.probe));
    const int frames = options.frames.value_or(1);
    for (int frame = 0; frame < frames; ++frame) {
        scene.advance_to(frame * kSecondsPerFrame);
        // Maps are filled for what has come to rest.
        if (frames == 1) picture.draw(scene.world(), scene.camera(), 0.0F);
        picture.draw(scene.world(), scene.camera(), static_cast<float>(kSecondsPerFrame));
        if (job.capture_linear) {
            const auto path = view::numbered(*job.capture_linear, frame, frames);
            view::write_linear_capture(picture.linear(), path);
            log_info("wrote {}", path.string());
        }
        if (job.capture) {
            const auto path = view::numbered(*job.capture, frame, frames);
            view::write_display_capture(picture.encoded(), path);
            log_info("wrote {}", path.string());
        }
    }
}

void run_headless(const Options& options, const post::OcioConfig& config) {
    const platform::HeadlessContext context;
    gpu::enable_debug_output(false);
    log_info("rendering on {}", context.renderer());
    const auto started = std::chrono::steady_clock::now();
    const std::unique_ptr<view::Picture> opened =
        open_picture(options, config, {options.width, options.height}, options.benchmark ? Pace::Fluent : Pace::Still);
    view::Picture& picture = *opened;
    Assets assets(options, picture.renderer().gltf_extensions());
    DemoScene scene(options, assets, picture.renderer(), picture.xyz_to_working());
    if (options.benchmark) {
        picture.set_probe(*assets.probe(probe_paths(options)[0]));
        write_benchmark(*options.benchmark, fly_around(picture, scene, options.frames.value_or(kBenchmarkFrames)),
                        context.renderer());
        log_info("wrote {}", options.benchmark->string());
        return;
    }
    for (const Job& job : jobs(options)) run_job(job, options, picture, assets, scene);
    log_info("done in {:.1f} s", std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count());
}

int run(int argc, char** argv) {
    std::optional<Options> options = parse_options(argc, argv);
    if (!options) return 0;
    if (options->cooked_folder.empty()) options->cooked_folder = default_cooked_folder();
    const post::OcioConfig config = post::OcioConfig::choose(options->ocio_config);
    if (options->list_views) {
        for (const std::string& view : config.views(config.default_display())) std::puts(view.c_str());
    } else if (needs_a_window(*options)) {
        run_in_window(*options, config);
    } else {
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
