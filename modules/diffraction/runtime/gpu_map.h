#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"

namespace rowland::diffraction {

/// Largest magnitude of a component, above 0.
float largest_component(std::span<const glm::vec3> xyz);
float largest_component(std::span<const glm::vec4> values);

/// A map of radiance (XYZ) on the GPU, divided by its largest component: in fp16, which ends at 65504, or in 10 bits.
class GpuMap {
 public:
    GpuMap() = default;
    /// A map without values. `scale`: the largest component to come. upload() takes values divided by it: halves, four
    /// per texel, or texels of RGB10_A2. `spare` is a map that is no longer shown: its texture is used again if it has
    /// the size. Maps of one size are sampled in one way.
    GpuMap(const gpu::TextureDesc& desc, const gpu::Sampling& sampling, float scale, GpuMap spare);
    void upload(std::span<const std::uint16_t> halves, gpu::TextureSlice slice) { texture_.upload(halves, slice); }
    void upload(std::span<const std::uint32_t> packed, gpu::TextureSlice slice) { texture_.upload(packed, slice); }

    /// `second`: beside another map of the same program.
    void bind(const gpu::Program& program, bool second) const;

 private:
    gpu::Texture texture_;
    float scale_ = 1.0F;
};

}  // namespace rowland::diffraction
