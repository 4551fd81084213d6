#include "modules/diffraction/representations/planar/lobe_filling.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/parallel.h"

namespace rowland::diffraction {

namespace {

LobeMapSize coarser(const LobeMapSize& size) {
    return {.azimuths = std::min(kCoarseLobeMap.azimuths, size.azimuths),
            .views = {.g = std::min(kCoarseLobeMap.views.g, size.views.g),
                      .h = std::min(kCoarseLobeMap.views.h, size.views.h)}};
}

MapTexels in_layout(const LobeMap& map) {
    MapTexels texels{
        .desc = {.kind = gpu::TextureKind::Volume,
                 .width = map.size.views.g,
                 .height = map.size.views.h,
                 .depth = slices(map.size, map.half_turn)},
        .sampling = {.filter = gpu::Filter::Linear, .wrap_r = map.half_turn ? gpu::Wrap::Clamp : gpu::Wrap::Repeat},
        .scale = largest_component(map.values),
        .halves = std::vector<std::uint16_t>(4 * map.values.size(), 0)};
    const std::size_t slice = map.values.size() / static_cast<std::size_t>(texels.desc.depth);
    parallel_for(static_cast<std::size_t>(texels.desc.depth), [&](std::size_t task) {
        for (std::size_t i = task * slice; i < (task + 1) * slice; ++i) {
            const glm::u16vec4 halves = glm::packHalf(glm::vec4(map.values[i] / texels.scale, 0.0F));
            for (int o = 0; o < 3; ++o) texels.halves[4 * i + static_cast<std::size_t>(o)] = halves[o];
        }
    });
    return texels;
}

}  // namespace

LobeMapper::LobeMapper(const PlanarLobe& lobe, const glm::dmat3& xyz_to_working)
    : coarse_{coarser(lobe.size).azimuths,
              LobeSpectrum(in_space(lobe.pattern, xyz_to_working), coarser(lobe.size).views)},
      full_{lobe.size.azimuths, LobeSpectrum(in_space(lobe.pattern, xyz_to_working), lobe.size.views)} {}

LobeFilling::Filled LobeFilling::fill(const Key& key, const LobeMapper::Level& level, const std::stop_token& stop) {
    const LobeMap map = fill_lobe_map(*key.texels, level.spectrum, key.normal, level.azimuths, stop);
    if (stop.stop_requested()) return {};
    return {.texels = std::make_shared<MapTexels>(in_layout(map)),
            .size = map.size,
            .half_turn = map.half_turn,
            .axes = map.axes};
}

void LobeFilling::want(const Key& key, const std::shared_ptr<const LobeMapper>& mapper) {
    if (wanted_ == key) return;
    // An object that turns in every frame would never get a map if each frame began another one.
    if (wanted_ && filling_.busy() && !filling_.is_of(*wanted_)) return;
    wanted_ = key;
    complete_ = false;
    ++fills_begun_;
    filling_.want(key,
                  [key, mapper](const std::stop_token& stop, const Filling::Publish& publish) -> std::optional<Filled> {
                      Filled coarse = fill(key, mapper->coarse(), stop);
                      if (stop.stop_requested()) return std::nullopt;
                      publish(std::move(coarse));
                      Filled full = fill(key, mapper->full(), stop);
                      if (stop.stop_requested()) return std::nullopt;
                      full.full = true;
                      return full;
                  });
}

void LobeFilling::take_over(const Filling::Change& change) {
    if (!change.failure.empty()) fail_system("", "a map that cannot be filled: " + change.failure);
    if (!change.value) return;
    uploading_ = *filling_.value();
    upload_.emplace(uploading_.texels);
}

void LobeFilling::upload(int slices) {
    // A coarse map is small.
    if (!upload_ || !upload_->upload(uploading_.full ? slices : std::numeric_limits<int>::max())) return;
    map_ = upload_->take();
    upload_.reset();
    shown_ = std::exchange(uploading_, {});
    complete_ = shown_->full && filling_.current();
    ++maps_shown_;
}

void LobeFilling::update(const Key& key, const std::shared_ptr<const LobeMapper>& mapper, int slices_per_frame) {
    take_over(filling_.poll());
    want(key, mapper);
    if (slices_per_frame >= mapper->full().azimuths) {
        take_over(filling_.wait());
        want(key, mapper);
        take_over(filling_.wait());
    }
    upload(slices_per_frame);
}

void LobeFilling::bind(const gpu::Program& program) const {
    map_->bind(program);
    program.set("planar_e1", glm::vec3(shown_->axes.e1));
    program.set("planar_e2", glm::vec3(shown_->axes.e2));
    const LobeMapSize& size = shown_->size;
    const double slices = diffraction::slices(size, shown_->half_turn);
    program.set("lobe_map_axes", glm::vec4(glm::dvec4(0.5 - 0.5 / size.views.g, 0.5 - 0.5 / size.views.h,
                                                      size.azimuths / slices, 0.5 / slices)));
}

}  // namespace rowland::diffraction
