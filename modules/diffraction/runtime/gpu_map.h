#pragma once

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

    void bind(const gpu::Program& program) const;

 private:
    gpu::Texture texture_;
    float scale_ = 1.0F;
};

}  // namespace rowland::diffraction
