#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "content/demo/session.h"
#include "engine/platform/frame_pacing.h"

namespace rowland::demo {

/// What a flight through the scene took.
struct BenchmarkResult {
    struct Pass {
        std::string name;
        platform::FrameStatistics cpu;
        platform::FrameStatistics gpu;  ///< of the frames whose GPU time was known in time
    };
    glm::ivec2 size{0};
    platform::FrameStatistics frame;  ///< from the first command to the last pixel
    /// What gratings cost: median over some of the frames of their time over that of the same without gratings, which
    /// is drawn right after.
    double times_plain = 0.0;
    std::vector<Pass> passes;  ///< in the order they run
    int drawn = 0;             ///< objects in the last frame
    int culled = 0;
};

/// Flies once around the scene in so many frames, 1/30 s of the scene's time apart, and waits for each to be finished.
/// The first frames, which compile and upload, are drawn before and not counted.
BenchmarkResult fly_around(Session& session, int frames);

/// Writes it as JSON. `device` is the OpenGL renderer's name. Throws Error (system).
void write_benchmark(const std::filesystem::path& path, const BenchmarkResult& result, const std::string& device);

}  // namespace rowland::demo
