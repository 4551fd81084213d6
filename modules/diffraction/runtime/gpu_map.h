#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"

namespace rowland::diffraction {

/// A map of radiance (XYZ) on the GPU, as halves over its largest component: fp16 ends at 65504.
class GpuMap {
 public:
    GpuMap() = default;
    /// `xyz` as the texture's rows and slices lie; sampled linearly.
    GpuMap(std::span<const glm::vec3> xyz, gpu::TextureDesc desc, const gpu::Sampling& sampling);

    /// One without values yet, `scale` the largest there will be; upload() takes halves over it, three a texel.
    GpuMap(gpu::TextureDesc desc, const gpu::Sampling& sampling, float scale);
    void upload(std::span<const std::uint16_t> halves, gpu::TextureSlice slice) { texture_.upload(halves, slice); }

    void bind(const gpu::Program& program) const;

 private:
    gpu::Texture texture_;
    float scale_ = 1.0F;
};

}  // namespace rowland::diffraction
