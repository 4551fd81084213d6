#include "modules/diffraction/runtime/gpu_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/packing.hpp>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
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

namespace {

constexpr std::size_t kTexelsPerTask = 1 << 14;

glm::vec4 texel_of(const glm::vec3& value) {
    return {value, 0.0F};
}

glm::vec4 texel_of(const glm::vec4& value) {
    return value;
}

template <typename Value>
std::vector<std::uint16_t> as_halves(const std::vector<Value>& values, float scale) {
    std::vector<std::uint16_t> halves(4 * values.size());
    parallel_for((values.size() + kTexelsPerTask - 1) / kTexelsPerTask, [&](std::size_t task) {
        const std::size_t end = std::min(values.size(), (task + 1) * kTexelsPerTask);
        for (std::size_t i = task * kTexelsPerTask; i < end; ++i) {
            const glm::u16vec4 texel = glm::packHalf(texel_of(values[i] / scale));
            for (int o = 0; o < 4; ++o) halves[4 * i + static_cast<std::size_t>(o)] = texel[o];
        }
    });
    return halves;
}

template <typename Value>
MapTexels packed(std::span<const std::vector<Value>> levels, gpu::TextureDesc desc, const gpu::Sampling& sampling) {
    desc.levels = static_cast<int>(levels.size());
    MapTexels texels{.desc = desc, .sampling = sampling, .scale = 0.0F, .levels = {}};
    for (const auto& values : levels) texels.scale = std::max(texels.scale, largest_component(values));
    for (const auto& values : levels) texels.levels.push_back(as_halves(values, texels.scale));
    return texels;
}

}  // namespace

MapTexels pack(std::span<const std::vector<glm::vec3>> levels, gpu::TextureDesc desc, const gpu::Sampling& sampling) {
    return packed(levels, desc, sampling);
}

MapTexels pack(std::span<const std::vector<glm::vec4>> levels, gpu::TextureDesc desc, const gpu::Sampling& sampling) {
    return packed(levels, desc, sampling);
}

namespace {

/// The texel of RGB9_E5 for components from 0 to 1.
std::uint32_t shared_exponent(const glm::vec3& value) {
    constexpr int kBits = 9;
    constexpr int kBias = 15;
    const float largest = std::max({value.x, value.y, value.z});
    int exponent = std::max(largest > 0.0F ? std::ilogb(largest) + 1 : -kBias, -kBias);
    if (std::lround(std::ldexp(largest, kBits - exponent)) == 1 << kBits) ++exponent;
    std::uint32_t texel = static_cast<std::uint32_t>(exponent + kBias) << (3 * kBits);
    const float scale = std::ldexp(1.0F, kBits - exponent);
    for (int i = 0; i < 3; ++i) texel |= static_cast<std::uint32_t>(std::lround(scale * value[i])) << (kBits * i);
    return texel;
}

/// `texel_of`: of a value that was divided by the map's largest component.
template <typename TexelOf>
MapTexels as_words(std::span<const glm::vec3> values, gpu::TextureDesc desc, const gpu::Sampling& sampling,
                   const TexelOf& texel_of) {
    MapTexels texels{.desc = desc, .sampling = sampling, .scale = largest_component(values)};
    texels.words.resize(values.size());
    parallel_for((values.size() + kTexelsPerTask - 1) / kTexelsPerTask, [&](std::size_t task) {
        const std::size_t end = std::min(values.size(), (task + 1) * kTexelsPerTask);
        for (std::size_t i = task * kTexelsPerTask; i < end; ++i) texels.words[i] = texel_of(values[i] / texels.scale);
    });
    return texels;
}

}  // namespace

MapTexels pack_xyz(std::span<const glm::vec3> values, gpu::TextureDesc desc, const gpu::Sampling& sampling) {
    desc.format = gpu::Format::RGB9_E5;
    return as_words(values, desc, sampling,
                    [](const glm::vec3& value) { return shared_exponent(glm::max(value, 0.0F)); });
}

MapTexels pack_ten_bits(std::span<const glm::vec3> values, gpu::TextureDesc desc, const gpu::Sampling& sampling) {
    desc.format = gpu::Format::RGB10_A2;
    return as_words(values, desc, sampling, [](const glm::vec3& value) {
        return glm::packUnorm3x10_1x2(glm::vec4(0.5F + 0.5F * value, 1.0F));
    });
}

GpuMap::GpuMap(MapTexels texels, std::vector<gpu::Texture>& spare) : texels_(std::move(texels)) {
    const gpu::TextureDesc& desc = texels_.desc;
    const auto fitting =
        std::ranges::find_if(spare, [&](const gpu::Texture& texture) { return texture.desc() == desc; });
    if (fitting == spare.end()) {
        texture_ = gpu::Texture(desc, texels_.sampling);
    } else {
        texture_ = std::move(*fitting);
        spare.erase(fitting);
    }
}

template <typename Word>
void GpuMap::upload_slices(std::span<const Word> words, int count) {
    const std::size_t slice = words.size() / static_cast<std::size_t>(std::max(1, texels_.desc.depth >> level_));
    texture_.upload(words.subspan(static_cast<std::size_t>(slice_) * slice, static_cast<std::size_t>(count) * slice),
                    {.level = static_cast<int>(level_), .layer = slice_, .layers = count});
}

bool GpuMap::upload(int slices) {
    const auto levels = static_cast<std::size_t>(texels_.desc.levels);
    for (int left = std::max(1, slices); left > 0 && level_ < levels;) {
        const int depth = std::max(1, texels_.desc.depth >> level_);
        const int count = std::min(left, depth - slice_);
        if (texels_.levels.empty())
            upload_slices(std::span<const std::uint32_t>(texels_.words), count);
        else
            upload_slices(std::span<const std::uint16_t>(texels_.levels[level_]), count);
        left -= count;
        slice_ += count;
        if (slice_ < depth) break;
        slice_ = 0;
        ++level_;
    }
    if (level_ < levels) return false;
    texels_.levels.clear();
    texels_.words = std::vector<std::uint32_t>();  // {} would keep the memory
    return true;
}

void GpuMap::bind(const gpu::Program& program, bool second) const {
    ROWLAND_CHECK_OP(level_, ==, static_cast<std::size_t>(texels_.desc.levels));
    texture_.bind(second ? kSecondMapUnit : kMapUnit);
    program.set(second ? "second_map_scale" : "map_scale", texels_.scale);
}

}  // namespace rowland::diffraction
