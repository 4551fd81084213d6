#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "modules/diffraction/runtime/gpu_map.h"

namespace rowland::diffraction {

/// A volume map in its texture's layout, for MapUpload.
struct MapTexels {
    gpu::TextureDesc desc;
    gpu::Sampling sampling;
    float scale = 1.0F;                 ///< of the halves
    std::vector<std::uint16_t> halves;  ///< four per texel
};

/// Uploads a volume map, some slices at a time.
class MapUpload {
 public:
    /// Clears the halves when all are uploaded.
    explicit MapUpload(std::shared_ptr<MapTexels> texels);

    /// Uploads up to so many slices, at least one; true when all are uploaded.
    bool upload(int slices);

    /// All must be uploaded.
    GpuMap take();

 private:
    std::shared_ptr<MapTexels> texels_;
    GpuMap map_;
    int uploaded_ = 0;
};

}  // namespace rowland::diffraction
