#include "modules/diffraction/runtime/gpu_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

GpuMap::GpuMap(const gpu::TextureDesc& desc, const gpu::Sampling& sampling, float scale, GpuMap spare) : scale_(scale) {
    const gpu::TextureDesc& old = spare.texture_.desc();
    const bool fits = spare.texture_.id() != 0 && old.kind == desc.kind && old.format == desc.format &&
                      old.width == desc.width && old.height == desc.height && old.depth == desc.depth &&
                      old.levels == desc.levels;
    texture_ = fits ? std::move(spare.texture_) : gpu::Texture(desc, sampling);
}

void GpuMap::bind(const gpu::Program& program, bool second) const {
    texture_.bind(second ? kSecondMapUnit : kMapUnit);
    program.set(second ? "second_map_scale" : "map_scale", scale_);
}

}  // namespace rowland::diffraction
