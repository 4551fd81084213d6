#include "modules/diffraction/runtime/map_filling.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/log.h"

namespace rowland::diffraction {

namespace {

/// Of a full map, in one frame.
constexpr int kSlicesPerFrame = 8;
constexpr int kAllSlices = std::numeric_limits<int>::max();

FilledMap filled(const FillMap& fill, MapInput input, MapDetail detail, const std::stop_token& stop = {}) {
    if (!input.texels) input.texels = std::make_shared<const lighting::LightSamples>();
    return fill(input, detail, stop);
}

}  // namespace

void MapFilling::warn_of_black(const MapInput& input) const {
    if (!input.texels && (!wanted_ || wanted_->texels))
        log_warning("the map of a grating is under a probe without texels: it stays dark");
}

void MapFilling::fill_now(const MapInput& input, const FillMap& fill, MapDetail detail) {
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
    if (uploads_.empty() || !std::ranges::all_of(uploads_, [&](MapUpload& part) { return part.upload(wanted); }))
        return;
    spare_ = std::exchange(map_, {});
    for (MapUpload& part : uploads_) map_.push_back(part.take());
    uploads_.clear();
    shown_ = std::exchange(uploading_, std::nullopt);
    ++maps_shown_;
}

void MapFilling::update(const MapInput& input, const std::shared_ptr<const FillMap>& fill, MapPace pace) {
    warn_of_black(input);
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
        fill_now(input, *fill, MapDetail::Coarse);
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
