#include "content/demo/benchmark.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "content/demo/camera_path.h"
#include "engine/core/file.h"
#include "engine/core/progress.h"
#include "engine/scene/transform.h"

namespace rowland::demo {

namespace {

constexpr int kFramesPerSecond = 30;
constexpr int kWarmUpFrames = 3;

std::chrono::nanoseconds nanoseconds(double ms) {
    return std::chrono::nanoseconds(static_cast<std::int64_t>(ms * 1e6));
}

/// The times of one pass, frame by frame.
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

BenchmarkResult fly_around(Session& session, int frames) {
    view::Picture& picture = session.picture();
    const auto capacity = static_cast<std::size_t>(frames);
    platform::FrameTimes frame_times(capacity);
    std::vector<PassSamples> passes;
    Progress progress("frames", capacity);
    for (int frame = -kWarmUpFrames; frame < frames; ++frame) {
        const int shown = std::max(frame, 0);
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; frame > 0 && i < kStepsPerSecond / kFramesPerSecond; ++i) session.play().step({});
        scene::update_world_matrices(session.scene().world());
        picture.draw(session.scene().world(), flight(session.scene().camera(), static_cast<double>(shown) / frames),
                     1.0F / kFramesPerSecond);
        glFinish();
        if (frame < 0) continue;
        frame_times.add(std::chrono::steady_clock::now() - start);
        add(passes, picture.pass_times().latest(), capacity);
        progress.advance();
    }
    BenchmarkResult result;
    result.size = picture.encoded().size();
    result.frame = frame_times.statistics();
    for (const PassSamples& pass : passes)
        result.passes.push_back({pass.name, pass.cpu.statistics(), pass.gpu.statistics()});
    result.drawn = picture.renderer().report().drawn;
    result.culled = picture.renderer().report().culled;
    return result;
}

void write_benchmark(const std::filesystem::path& path, const BenchmarkResult& result, const std::string& device) {
    nlohmann::ordered_json passes = nlohmann::ordered_json::array();
    for (const BenchmarkResult::Pass& pass : result.passes)
        passes.push_back({{"name", pass.name}, {"cpu", to_json(pass.cpu)}, {"gpu", to_json(pass.gpu)}});
    const nlohmann::ordered_json json = {
        {"device", device}, {"width", result.size.x}, {"height", result.size.y}, {"frame", to_json(result.frame)},
        {"passes", passes}, {"drawn", result.drawn},  {"culled", result.culled}};
    write_file_atomic(path, json.dump(2) + "\n");
}

}  // namespace rowland::demo
