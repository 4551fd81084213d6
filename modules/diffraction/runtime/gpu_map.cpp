#include "modules/diffraction/runtime/gpu_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
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

MapTexels pack_ten_bits(std::span<const glm::vec3> values, gpu::TextureDesc desc, const gpu::Sampling& sampling) {
    desc.format = gpu::Format::RGB10_A2;
    MapTexels texels{.desc = desc, .sampling = sampling, .scale = largest_component(values)};
    texels.ten_bits.resize(values.size());
    parallel_for((values.size() + kTexelsPerTask - 1) / kTexelsPerTask, [&](std::size_t task) {
        const std::size_t end = std::min(values.size(), (task + 1) * kTexelsPerTask);
        for (std::size_t i = task * kTexelsPerTask; i < end; ++i)
            texels.ten_bits[i] = glm::packUnorm3x10_1x2(glm::vec4(0.5F + 0.5F * values[i] / texels.scale, 1.0F));
    });
    return texels;
}

GpuMap::GpuMap(MapTexels texels, GpuMap spare) : texels_(std::move(texels)) {
    const gpu::TextureDesc& desc = texels_.desc;
    const gpu::TextureDesc& old = spare.texture_.desc();
    const bool fits = spare.texture_.id() != 0 && old.kind == desc.kind && old.format == desc.format &&
                      old.width == desc.width && old.height == desc.height && old.depth == desc.depth &&
                      old.levels == desc.levels;
    texture_ = fits ? std::move(spare.texture_) : gpu::Texture(desc, texels_.sampling);
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
            upload_slices(std::span<const std::uint32_t>(texels_.ten_bits), count);
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
    texels_.ten_bits = {};
    return true;
}

void GpuMap::bind(const gpu::Program& program, bool second) const {
    ROWLAND_CHECK_OP(level_, ==, static_cast<std::size_t>(texels_.desc.levels));
    texture_.bind(second ? kSecondMapUnit : kMapUnit);
    program.set(second ? "second_map_scale" : "map_scale", texels_.scale);
}

namespace {

/// Of a full map, in one frame.
constexpr int kSlicesPerFrame = 8;
constexpr int kAllSlices = std::numeric_limits<int>::max();

FilledMap filled(const FillMap& fill, MapInput input, MapDetail detail, const std::stop_token& stop = {}) {
    if (!input.texels) input.texels = std::make_shared<const lighting::LightSamples>();
    return fill(input, detail, stop);
}

}  // namespace

void MapFilling::fill_now(const MapInput& input, const FillMap& fill, MapDetail detail) {
    if (!input.texels && (!shown_ || shown_->input.texels))
        log_warning("the map of a grating is under a probe without texels: it stays dark");
    begin_upload({std::make_shared<FilledMap>(filled(fill, input, detail)), input, detail});
    upload(kAllSlices);
}

void MapFilling::want(const MapInput& input, const std::shared_ptr<const FillMap>& fill) {
    if (wanted_ == input) return;
    // An object that turns in every frame would never get a map if each frame began another one.
    if (wanted_ && filling_.busy() && !filling_.is_of(*wanted_)) return;
    wanted_ = input;
    ++fills_begun_;
    const bool coarse = !shown_ || shown_->input != input;
    filling_.want(
        input,
        [input, fill, coarse](const std::stop_token& stop, const Filling::Publish& publish) -> std::optional<Filled> {
            const auto fill_to = [&](MapDetail detail) {
                return Filled{std::make_shared<FilledMap>(filled(*fill, input, detail, stop)), input, detail};
            };
            if (coarse) {
                Filled first = fill_to(MapDetail::Coarse);
                if (stop.stop_requested()) return std::nullopt;
                publish(std::move(first));
            }
            Filled full = fill_to(MapDetail::Full);
            if (stop.stop_requested()) return std::nullopt;
            return full;
        });
}

void MapFilling::begin_upload(Filled filled) {
    spare_.resize(2);
    uploads_.clear();
    uploads_.emplace_back(std::move(filled.map->texels), std::move(spare_[0]));
    if (filled.map->second) uploads_.emplace_back(std::move(*filled.map->second), std::move(spare_[1]));
    spare_.clear();
    uploading_ = std::move(filled);
}

void MapFilling::upload(int slices) {
    // A coarse map is small.
    const int wanted = uploading_ && uploading_->detail == MapDetail::Full ? slices : kAllSlices;
    if (uploads_.empty() || !std::ranges::all_of(uploads_, [&](GpuMap& part) { return part.upload(wanted); })) return;
    spare_ = std::exchange(map_, std::exchange(uploads_, {}));
    shown_ = std::exchange(uploading_, std::nullopt);
    ++maps_shown_;
}

void MapFilling::update(const MapInput& input, const std::shared_ptr<const FillMap>& fill, MapPace pace) {
    if (pace == MapPace::Whole) {
        if (is_complete() && wanted_ == input) return;
        filling_.reset();
        wanted_ = input;
        ++fills_begun_;
        return fill_now(input, *fill, MapDetail::Full);
    }
    if (const bool new_light = !shown_ || shown_->input.texels != input.texels; new_light) {
        filling_.reset();
        wanted_.reset();
        // The next frame begins the full map: in this one, other maps and the driver's compiler need the cores.
        return fill_now(input, *fill, MapDetail::Coarse);
    }
    const Filling::Change change = filling_.poll();
    if (!change.failure.empty()) fail_system("", "a map that cannot be filled: " + change.failure);
    if (change.value) begin_upload(*filling_.value());
    want(input, fill);
    upload(kSlicesPerFrame);
}

void MapFilling::bind(const gpu::Program& program) const {
    for (std::size_t i = 0; i < map_.size(); ++i) map_[i].bind(program, i > 0);
    if (shown_->map->set_uniforms) shown_->map->set_uniforms(program);
}

}  // namespace rowland::diffraction
