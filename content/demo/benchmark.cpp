#include "content/demo/benchmark.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "content/demo/camera_path.h"
#include "engine/core/progress.h"
#include "engine/platform/frame_pacing.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::demo {

namespace {

constexpr int kWarmUpFrames = 3;

std::chrono::nanoseconds nanoseconds(double ms) {
    return std::chrono::nanoseconds(static_cast<std::int64_t>(ms * 1e6));
}

/// During its life gratings are drawn as the plain surfaces under them.
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
    scene::update_world_matrices(session.scene().world());
    session.picture().draw(session.scene().world(), camera, 1.0F / kFramesPerSecond);
    glFinish();
    return std::chrono::steady_clock::now() - start;
}

/// The median ratio of a frame's time to that of the same frame without gratings, drawn right after it.
double times_plain(Session& session, int frames) {
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

/// The times of one pass in each frame. The GPU's may come too late to be known.
struct PassSamples {
    std::string name;
    platform::FrameTimes cpu;
    platform::FrameTimes gpu;
};

void add(std::vector<PassSamples>& passes, const std::vector<gpu::PassTime>& times, std::size_t capacity) {
    for (const gpu::PassTime& time : times) {
        auto found =
            std::find_if(passes.begin(), passes.end(), [&](const auto& pass) { return pass.name == time.name; });
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

}  // namespace

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
                                     {"times_plain", times_plain(session, std::clamp(frames / 4, 1, 40))},
                                     {"passes", nlohmann::ordered_json::array()}};
    for (const PassSamples& pass : passes)
        report["passes"].push_back(
            {{"name", pass.name}, {"cpu", to_json(pass.cpu.statistics())}, {"gpu", to_json(pass.gpu.statistics())}});
    report["drawn"] = picture.renderer().report().drawn;
    report["culled"] = picture.renderer().report().culled;
    return report;
}

}  // namespace rowland::demo
