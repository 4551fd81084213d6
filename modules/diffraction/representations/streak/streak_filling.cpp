#include "modules/diffraction/representations/streak/streak_filling.h"

#include <algorithm>
#include <chrono>
#include <glm/gtc/packing.hpp>
#include <utility>

#include "engine/core/check.h"

namespace rowland::diffraction {

namespace {

constexpr gpu::Sampling kStreakSampling{.filter = gpu::Filter::Trilinear, .wrap_r = gpu::Wrap::Repeat};

}  // namespace

GpuMap black_streak_map() {
    const std::array<glm::vec3, 1> black{};
    return {black, {.kind = gpu::TextureKind::Volume}, kStreakSampling};
}

StreakFilling::Filled StreakFilling::fill(const std::stop_token& stop, const lighting::LightSamples& texels,
                                          const StreakMapSize& size) {
    const StreakMap map = fill_streak_map(texels, size, stop);
    if (stop.stop_requested()) return {};
    Filled filled{.desc = {.kind = gpu::TextureKind::Volume,
                           .width = map.columns(0),
                           .height = map.rows(0),
                           .depth = map.slices(0),
                           .levels = kStreakLevels},
                  .scale = 0.0F,
                  .levels = {}};
    for (const std::vector<glm::vec3>& level : map.levels)
        filled.scale = std::max(filled.scale, largest_component(level));
    for (std::size_t level = 0; level < kStreakLevels; ++level) {
        filled.levels[level].reserve(4 * map.levels[level].size());
        for (const glm::vec3& rgb : map.levels[level]) {
            for (int c = 0; c < 3; ++c) filled.levels[level].push_back(glm::packHalf1x16(rgb[c] / filled.scale));
            filled.levels[level].push_back(0);
        }
    }
    return filled;
}

StreakFilling::StreakFilling(std::shared_ptr<const lighting::LightSamples> texels, const StreakMapSize& size) {
    std::packaged_task<Filled(std::stop_token)> task(
        [texels = std::move(texels), size](const std::stop_token& stop) { return fill(stop, *texels, size); });
    filled_later_ = task.get_future();
    thread_ = std::jthread(std::move(task));
}

bool StreakFilling::upload(int slices) {
    if (!filled_) {
        if (filled_later_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
        filled_ = filled_later_.get();
        map_.emplace(filled_->desc, kStreakSampling, filled_->scale);
    }
    for (int left = std::max(1, slices); left > 0 && level_ < kStreakLevels;) {
        const std::vector<std::uint16_t>& halves = filled_->levels[static_cast<std::size_t>(level_)];
        const int depth = filled_->desc.depth >> level_;
        const std::size_t slice = halves.size() / static_cast<std::size_t>(depth);
        const int count = std::min(left, depth - slice_);
        map_->upload(std::span<const std::uint16_t>(halves).subspan(static_cast<std::size_t>(slice_) * slice,
                                                                    static_cast<std::size_t>(count) * slice),
                     {.level = level_, .layer = slice_, .layers = count});
        left -= count;
        slice_ += count;
        if (slice_ < depth) break;
        slice_ = 0;
        ++level_;
    }
    return level_ == kStreakLevels;
}

GpuMap StreakFilling::take() {
    ROWLAND_CHECK(map_.has_value() && level_ == kStreakLevels, "a map that is uploaded");
    return std::move(*map_);
}

}  // namespace rowland::diffraction
