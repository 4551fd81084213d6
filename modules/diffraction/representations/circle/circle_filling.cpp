#include "modules/diffraction/representations/circle/circle_filling.h"

#include <algorithm>
#include <chrono>
#include <glm/gtc/packing.hpp>
#include <utility>

#include "engine/core/check.h"

namespace rowland::diffraction {

namespace {

/// Charts side by side and terms below each other, for one volume texture.
std::vector<std::uint16_t> side_by_side(const CircleMap& map, float scale) {
    std::vector<std::uint16_t> halves;
    halves.reserve(4 * map.xyz.size());
    for (int view = 0; view < map.views; ++view)
        for (int term = 0; term < map.terms; ++term)
            for (int row = 0; row < map.side; ++row)
                for (int chart = 0; chart < map.charts; ++chart) {
                    const glm::vec3* texels = map.xyz.data() + map.index(chart, term, view, row, 0);
                    for (int column = 0; column < map.side; ++column) {
                        for (int o = 0; o < 3; ++o) halves.push_back(glm::packHalf1x16(texels[column][o] / scale));
                        halves.push_back(0);
                    }
                }
    return halves;
}

}  // namespace

CircleFilling::Filled CircleFilling::fill(const std::stop_token& stop, const lighting::LightSamples& texels,
                                          const KernelTable& kernel, double pitch_nm, const CircleMapSize& size,
                                          const glm::dmat3& zero_order_xyz, const std::optional<Cover>& cover) {
    const CircleMap map = fill_circle_map(texels, kernel, pitch_nm, size, zero_order_xyz, cover, stop);
    if (stop.stop_requested()) return {};
    const float scale = largest_component(map.xyz);
    return {.desc = {.kind = gpu::TextureKind::Volume,
                     .width = map.side * map.charts,
                     .height = map.side * map.terms,
                     .depth = map.views},
            .scale = scale,
            .halves = side_by_side(map, scale)};
}

CircleFilling::CircleFilling(std::shared_ptr<const lighting::LightSamples> texels, const KernelTable& kernel,
                             double pitch_nm, const CircleMapSize& size, const glm::dmat3& zero_order_xyz,
                             const std::optional<Cover>& cover) {
    std::packaged_task<Filled(std::stop_token)> task(
        [texels = std::move(texels), kernel, pitch_nm, size, zero_order_xyz, cover](const std::stop_token& stop) {
            return fill(stop, *texels, kernel, pitch_nm, size, zero_order_xyz, cover);
        });
    filled_later_ = task.get_future();
    thread_ = std::jthread(std::move(task));
}

bool CircleFilling::upload(int slices) {
    if (!filled_) {
        if (filled_later_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
        filled_ = filled_later_.get();
        map_.emplace(filled_->desc, gpu::Sampling{.filter = gpu::Filter::Linear}, filled_->scale);
    }
    const gpu::TextureDesc& desc = filled_->desc;
    const int end = uploaded_ + std::min(std::max(1, slices), desc.depth - uploaded_);
    const std::size_t slice =
        std::size_t{4} * static_cast<std::size_t>(desc.width) * static_cast<std::size_t>(desc.height);
    map_->upload(
        std::span<const std::uint16_t>(filled_->halves)
            .subspan(static_cast<std::size_t>(uploaded_) * slice, static_cast<std::size_t>(end - uploaded_) * slice),
        {.layer = uploaded_, .layers = end - uploaded_});
    uploaded_ = end;
    return uploaded_ == desc.depth;
}

GpuMap CircleFilling::take() {
    ROWLAND_CHECK(map_.has_value() && uploaded_ == filled_->desc.depth, "a map that is uploaded");
    return std::move(*map_);
}

}  // namespace rowland::diffraction
