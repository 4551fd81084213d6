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

/// A map of radiance (XYZ) on the GPU: fp16, divided by its largest component, as fp16 ends at 65504.
class GpuMap {
 public:
    GpuMap() = default;
    /// A map without values. `scale`: the largest component to come. upload() takes halves divided by it, four per
    /// texel. `spare` is a map that is no longer shown: its texture is used again if it has the size. Maps of one size
    /// are sampled in one way.
    GpuMap(gpu::TextureDesc desc, const gpu::Sampling& sampling, float scale, GpuMap spare);
    void upload(std::span<const std::uint16_t> halves, gpu::TextureSlice slice) { texture_.upload(halves, slice); }

    void bind(const gpu::Program& program) const;

 private:
    gpu::Texture texture_;
    float scale_ = 1.0F;
};

}  // namespace rowland::diffraction
