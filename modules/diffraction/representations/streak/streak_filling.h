#pragma once

#include <array>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "engine/lighting/light_samples.h"
#include "modules/diffraction/representations/streak/streak_map.h"
#include "modules/diffraction/runtime/gpu_map.h"

namespace rowland::diffraction {

/// A map without light.
GpuMap black_streak_map();

/// Fills a streak map on its own thread; frames then upload some slices each. The destructor ends the thread within
/// milliseconds.
class StreakFilling {
 public:
    StreakFilling(std::shared_ptr<const lighting::LightSamples> texels, const StreakMapSize& size);

    /// Blocks until the map is filled.
    void wait() const { filled_later_.wait(); }
    /// Uploads up to so many slices of a filled map; true when all are uploaded. Rethrows the thread's exceptions.
    bool upload(int slices);

    /// The map must be uploaded.
    GpuMap take();

 private:
    /// A map as halves.
    struct Filled {
        gpu::TextureDesc desc;
        float scale = 1.0F;
        std::array<std::vector<std::uint16_t>, kStreakLevels> levels;
    };
    static Filled fill(const std::stop_token& stop, const lighting::LightSamples& texels, const StreakMapSize& size);

    std::future<Filled> filled_later_;
    std::optional<Filled> filled_;
    std::optional<GpuMap> map_;
    int level_ = 0;
    int slice_ = 0;        ///< of the level, the next to upload
    std::jthread thread_;  ///< last member: it stops before the others are destroyed
};

}  // namespace rowland::diffraction
