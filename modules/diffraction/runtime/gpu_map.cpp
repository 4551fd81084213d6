#include "modules/diffraction/runtime/gpu_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

namespace {

template <typename Value>
float largest_of(std::span<const Value> values) {
    float largest = 1e-30F;
    for (const Value& value : values)
        for (int i = 0; i < Value::length(); ++i) largest = std::max(largest, std::abs(value[i]));
    return largest;
}

}  // namespace

float largest_component(std::span<const glm::vec3> xyz) {
    return largest_of(xyz);
}

float largest_component(std::span<const glm::vec4> values) {
    return largest_of(values);
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
