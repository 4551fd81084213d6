#pragma once

#include <cstdint>
#include <future>
#include <glm/mat3x3.hpp>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "engine/lighting/light_samples.h"
#include "modules/diffraction/representations/circle/circle_map.h"
#include "modules/diffraction/runtime/gpu_map.h"

namespace rowland::diffraction {

/// Fills a circle map on its own thread; frames then upload some slices each. The destructor ends the thread within
/// milliseconds.
class CircleFilling {
 public:
    CircleFilling(std::shared_ptr<const lighting::LightSamples> texels, const KernelTable& kernel, double pitch_nm,
                  const CircleMapSize& size, const glm::dmat3& zero_order_xyz, const std::optional<Cover>& cover);

    /// Blocks until the map is filled.
    void wait() const { filled_later_.wait(); }
    /// Uploads up to so many slices of a filled map; true when all are uploaded. Rethrows the thread's exceptions.
    bool upload(int slices);

    /// The map must be uploaded.
    GpuMap take();

 private:
    /// A map in its texture's layout.
    struct Filled {
        gpu::TextureDesc desc;
        float scale = 1.0F;
        std::vector<std::uint16_t> halves;
    };
    static Filled fill(const std::stop_token& stop, const lighting::LightSamples& texels, const KernelTable& kernel,
                       double pitch_nm, const CircleMapSize& size, const glm::dmat3& zero_order_xyz,
                       const std::optional<Cover>& cover);

    std::future<Filled> filled_later_;
    std::optional<Filled> filled_;
    std::optional<GpuMap> map_;
    int uploaded_ = 0;
    std::jthread thread_;  ///< last member: it stops before the others are destroyed
};

}  // namespace rowland::diffraction
