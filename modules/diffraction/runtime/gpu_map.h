#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"

namespace rowland::diffraction {

/// Largest magnitude of a component, at least 1e-30.
float largest_component(std::span<const glm::vec3> xyz);
float largest_component(std::span<const glm::vec4> values);

/// A map in its texture's layout, divided by its largest component.
struct MapTexels {
    gpu::TextureDesc desc;
    gpu::Sampling sampling;
    float scale = 1.0F;  ///< the largest component
    /// Halves of each level, four per texel, or the packed texels of one level.
    std::vector<std::vector<std::uint16_t>> levels{};
    std::vector<std::uint32_t> words{};
};

/// `levels`: values in the order of each level's rows and slices. Uses all cores.
MapTexels pack(std::span<const std::vector<glm::vec3>> levels, gpu::TextureDesc desc, const gpu::Sampling& sampling);
MapTexels pack(std::span<const std::vector<glm::vec4>> levels, gpu::TextureDesc desc, const gpu::Sampling& sampling);

/// XYZ as RGB9_E5: nine bits per component and one exponent. Negative components become 0.
MapTexels pack_xyz(std::span<const glm::vec3> values, gpu::TextureDesc desc, const gpu::Sampling& sampling);

/// Values of either sign in ten bits per component, 0 to 1 for −scale to scale: one level, as RGB10_A2.
MapTexels pack_ten_bits(std::span<const glm::vec3> values, gpu::TextureDesc desc, const gpu::Sampling& sampling);

/// A map on the GPU, uploaded some slices at a time.
class GpuMap {
 public:
    GpuMap() = default;
    /// Takes a spare texture if one has the size. Maps of one size are sampled in one way.
    GpuMap(MapTexels texels, std::vector<gpu::Texture>& spare);

    /// Uploads up to so many slices, at least one; true when all are uploaded.
    bool upload(int slices);

    /// All slices must be uploaded. `second`: beside another map of the same program.
    void bind(const gpu::Program& program, bool second) const;
    gpu::Texture texture() && { return std::move(texture_); }

 private:
    /// Uploads a part of a level's slices.
    template <typename Word>
    void upload_slices(std::span<const Word> words, int count);

    MapTexels texels_;  ///< without values once they are uploaded
    gpu::Texture texture_;
    std::size_t level_ = 0;
    int slice_ = 0;  ///< of the level, the next to upload
};

}  // namespace rowland::diffraction
