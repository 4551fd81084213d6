#include "modules/diffraction/runtime/gpu_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

float largest_component(std::span<const glm::vec3> xyz) {
    float largest = 1e-30F;
    for (const glm::vec3& value : xyz)
        largest = std::max({largest, std::abs(value.x), std::abs(value.y), std::abs(value.z)});
    return largest;
}

GpuMap::GpuMap(std::span<const glm::vec3> xyz, const gpu::TextureDesc& desc, const gpu::Sampling& sampling)
    : GpuMap(desc, sampling, largest_component(xyz)) {
    std::vector<glm::vec3> stored(xyz.size());
    std::transform(xyz.begin(), xyz.end(), stored.begin(), [&](const glm::vec3& value) { return value / scale_; });
    texture_.upload(std::span<const glm::vec3>(stored), {.layers = desc.depth});
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
