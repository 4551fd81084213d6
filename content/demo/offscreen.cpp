#include "content/demo/run.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>
#include <vector>

#include "content/demo/assets.h"
#include "content/demo/camera_path.h"
#include "content/demo/play/recording.h"
#include "content/demo/session.h"
#include "engine/app/drawing_program.h"
#include "engine/cook/cook_source.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/platform/frame_pacing.h"
#include "engine/view/picture.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::demo {

namespace {

constexpr int kBenchmarkFrames = 300;
constexpr int kTourFrames = 12;
constexpr int kTourFramesPerSecond = 2;
constexpr std::size_t kTourProbes = 4;

void advance(Play& play, int frames_per_second) {
    for (int i = 0; i < kStepsPerSecond / frames_per_second; ++i) play.step({});
}

/// Writes the captures of frame `frame` of `frames`.
void write_frame_captures(Session& session, const Options& options, int frame, int frames) {
    if (options.capture_linear)
        view::write_linear_capture(session.picture().linear(), view::numbered(*options.capture_linear, frame, frames));
    if (options.capture)
        view::write_display_capture(session.picture().encoded(), view::numbered(*options.capture, frame, frames));
}

void write_captures(Session& session, const Options& options) {
    const int frames = options.captured_frames();
    for (int frame = 0; frame < frames; ++frame) {
        if (options.turntable) {
            session.draw_from(turned(session.play().camera(), static_cast<double>(frame) / frames),
                              1.0F / kFramesPerSecond);
        } else {
            if (frame > 0) advance(session.play(), kFramesPerSecond);
            session.draw(1.0F / kFramesPerSecond);
        }
        write_frame_captures(session, options, frame, frames);
    }
}

/// A flight through the scene's views as numbered PNG files. Each probe lights an equal number of frames.
void write_tour(Session& session, const Options& options) {
    std::vector<std::filesystem::path> probes = probe_paths(options);
    probes.resize(std::min(probes.size(), kTourProbes));
    const std::vector<scene::Camera> views = session.scene().views();
    const int frames = options.frames.value_or(kTourFrames);
    Progress progress("pictures", static_cast<std::size_t>(frames));
    for (int frame = 0; frame < frames; ++frame) {
        const auto& probe = probes[static_cast<std::size_t>(frame) * probes.size() / static_cast<std::size_t>(frames)];
        if (probe != session.probe_path()) session.use_probe(probe);
        if (frame > 0) advance(session.play(), kTourFramesPerSecond);
        const scene::Camera camera = tour(views, frames > 1 ? static_cast<double>(frame) / (frames - 1) : 0.0);
        session.draw_from(camera, 1.0F / kTourFramesPerSecond);
        const std::string name = fmt::format("flight_{:02}_{}.png", frame, probe.stem().string());
        view::write_display_capture(session.picture().encoded(), options.output_folder / name);
        progress.advance();
    }
}

/// Plays the recording at 30 frames per second, at most `options.frames`. Without --capture, the last frame goes to the
/// output folder.
void play_back(Session& session, const Options& options, const Recording& recording) {
    // 1 ns longer, so that rounding down cannot drop a step.
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
        write_frame_captures(session, options, static_cast<int>(frame), static_cast<int>(frames));
        progress.advance();
    }
    if (!options.captures() && frames > 0)
        view::write_display_capture(session.picture().encoded(), options.output_folder / "play.png");
    log_state(session.play());
}

constexpr int kWarmUpFrames = 3;

std::chrono::nanoseconds nanoseconds(double ms) {
    return std::chrono::nanoseconds(static_cast<std::int64_t>(ms * 1e6));
}

/// Removes the grating component from all entities while alive.
class WithoutGratings {
 public:
    explicit WithoutGratings(ecs::World& world) : world_(world) {
        world.view<diffraction::DiffractionSurface>().each(
            [&](ecs::Entity entity, const diffraction::DiffractionSurface& surface) {
                taken_.emplace_back(entity, surface);
            });
        for (const auto& [entity, surface] : taken_) world.remove<diffraction::DiffractionSurface>(entity);
    }
    ~WithoutGratings() {
        for (auto& [entity, surface] : taken_) world_.add(entity, std::move(surface));
    }
    WithoutGratings(const WithoutGratings&) = delete;
    WithoutGratings& operator=(const WithoutGratings&) = delete;

 private:
    ecs::World& world_;
    std::vector<std::pair<ecs::Entity, diffraction::DiffractionSurface>> taken_;
};

std::chrono::nanoseconds draw(Session& session, const scene::Camera& camera) {
    const auto start = std::chrono::steady_clock::now();
    session.draw_from(camera, 1.0F / kFramesPerSecond);
    glFinish();
    return std::chrono::steady_clock::now() - start;
}

/// Median over frames of the time with gratings divided by the time without, drawn back to back.
double ratio_to_plain(Session& session, int frames) {
    std::vector<double> ratios;
    for (int frame = -kWarmUpFrames; frame < frames; ++frame) {
        const scene::Camera camera = flight(session.scene().camera(), std::max(frame, 0) / static_cast<double>(frames));
        const double took = std::chrono::duration<double>(draw(session, camera)).count();
        const WithoutGratings plain(session.scene().world());
        const double took_plain = std::chrono::duration<double>(draw(session, camera)).count();
        if (frame >= 0) ratios.push_back(took / took_plain);
    }
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    return *middle;
}

/// The times of one pass in each frame. GPU times may be missing: queries arrive late.
struct PassSamples {
    std::string name;
    platform::FrameTimes cpu;
    platform::FrameTimes gpu;
};

void add(std::vector<PassSamples>& passes, const std::vector<gpu::PassTime>& times, std::size_t capacity) {
    for (const gpu::PassTime& time : times) {
        auto found = std::ranges::find(passes, time.name, &PassSamples::name);
        if (found == passes.end())
            found = passes.insert(passes.end(),
                                  {time.name, platform::FrameTimes(capacity), platform::FrameTimes(capacity)});
        found->cpu.add(nanoseconds(time.cpu_ms));
        if (time.gpu_ms) found->gpu.add(nanoseconds(*time.gpu_ms));
    }
}

nlohmann::ordered_json to_json(const platform::FrameStatistics& statistics) {
    return {{"frames", statistics.count},
            {"mean_ms", statistics.mean_ms},
            {"minimum_ms", statistics.minimum_ms},
            {"p50_ms", statistics.median_ms},
            {"p90_ms", statistics.percentile_90_ms},
            {"p95_ms", statistics.percentile_95_ms},
            {"p99_ms", statistics.percentile_99_ms},
            {"maximum_ms", statistics.maximum_ms}};
}

/// Flies once around the scene in `frames` frames, 1/30 s of the scene's time apart, each finished before the next.
/// Returns the report: "device" (as given), "width", "height", "frame" (time from the first command to the last pixel),
/// "times_plain" (ratio_to_plain()), "passes" (in their order), "drawn" and "culled" (objects in the last frame),
/// "baked" (sources that the program had to bake). The first frames, which compile and upload, are not counted.
nlohmann::ordered_json fly_around(Session& session, int frames, const std::string& device) {
    view::Picture& picture = session.picture();
    const auto capacity = static_cast<std::size_t>(frames);
    platform::FrameTimes frame_times(capacity);
    std::vector<PassSamples> passes;
    Progress progress("frames", capacity);
    for (int frame = -kWarmUpFrames; frame < frames; ++frame) {
        const int shown = std::max(frame, 0);
        for (int i = 0; frame > 0 && i < kStepsPerSecond / kFramesPerSecond; ++i) session.play().step({});
        const std::chrono::nanoseconds took =
            draw(session, flight(session.scene().camera(), static_cast<double>(shown) / frames));
        if (frame < 0) continue;
        frame_times.add(took);
        add(passes, picture.pass_times().latest(), capacity);
        progress.advance();
    }
    nlohmann::ordered_json report = {{"device", device},
                                     {"width", picture.encoded().size().x},
                                     {"height", picture.encoded().size().y},
                                     {"frame", to_json(frame_times.statistics())},
                                     {"times_plain", ratio_to_plain(session, std::clamp(frames / 4, 1, 40))},
                                     {"passes", nlohmann::ordered_json::array()}};
    for (const PassSamples& pass : passes)
        report["passes"].push_back(
            {{"name", pass.name}, {"cpu", to_json(pass.cpu.statistics())}, {"gpu", to_json(pass.gpu.statistics())}});
    report["drawn"] = picture.renderer().report().drawn;
    report["culled"] = picture.renderer().report().culled;
    report["baked"] = cook::sources_baked();
    return report;
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
        // Captures wait for automatic exposure and do not depend on timing; benchmarks do not wait.
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
