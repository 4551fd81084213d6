#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "modules/diffraction/runtime/gpu_map.h"

namespace rowland::diffraction {

/// A map in its texture's layout, for MapUpload.
struct MapTexels {
    gpu::TextureDesc desc;
    gpu::Sampling sampling;
    float scale = 1.0F;  ///< the largest component, by which the halves are divided
    /// Halves of each level, four per texel, or texels of RGB10_A2 in ten_bits.
    std::vector<std::vector<std::uint16_t>> levels{};
    std::vector<std::uint32_t> ten_bits{};
};

/// `levels`: values in the order of each level's rows and slices. Uses all cores.
MapTexels pack(std::span<const std::vector<glm::vec3>> levels, gpu::TextureDesc desc, const gpu::Sampling& sampling);
MapTexels pack(std::span<const std::vector<glm::vec4>> levels, gpu::TextureDesc desc, const gpu::Sampling& sampling);

/// Values of either sign in ten bits per component, 0 to 1 for −scale to scale: one level, as RGB10_A2.
MapTexels pack_ten_bits(std::span<const glm::vec3> values, gpu::TextureDesc desc, const gpu::Sampling& sampling);

/// Uploads a map, some slices at a time.
class MapUpload {
 public:
    /// Into the texture of `spare`, if it fits.
    explicit MapUpload(MapTexels texels, GpuMap spare = {});

    /// Uploads up to so many slices, at least one; true when all are uploaded.
    bool upload(int slices);

    /// All must be uploaded.
    GpuMap take();

 private:
    /// Uploads a part of a level's slices.
    template <typename Word>
    void upload_slices(std::span<const Word> words, int count);

    MapTexels texels_;
    GpuMap map_;
    std::size_t level_ = 0;
    int slice_ = 0;  ///< of the level, the next to upload
};

}  // namespace rowland::diffraction
