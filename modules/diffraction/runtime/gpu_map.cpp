#include "modules/diffraction/runtime/gpu_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

GpuMap::GpuMap(std::span<const glm::vec3> xyz, gpu::TextureDesc desc, const gpu::Sampling& sampling) {
    desc.format = gpu::Format::RGBA16F;
    texture_ = gpu::Texture(desc, sampling);
    scale_ = 1e-30F;
    for (const glm::vec3& value : xyz)
        scale_ = std::max({scale_, std::abs(value.x), std::abs(value.y), std::abs(value.z)});
    std::vector<glm::vec3> shares(xyz.size());
    std::transform(xyz.begin(), xyz.end(), shares.begin(), [&](const glm::vec3& value) { return value / scale_; });
    texture_.upload(std::span<const glm::vec3>(shares), {.layers = desc.depth});
}

GpuMap::GpuMap(gpu::TextureDesc desc, const gpu::Sampling& sampling, float scale) : scale_(scale) {
    desc.format = gpu::Format::RGBA16F;
    texture_ = gpu::Texture(desc, sampling);
}

void GpuMap::bind(const gpu::Program& program) const {
    texture_.bind(kMapUnit);
    program.set("map_scale", scale_);
}

}  // namespace rowland::diffraction
