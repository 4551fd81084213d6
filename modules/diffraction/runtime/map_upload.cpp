#include "modules/diffraction/runtime/map_upload.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "engine/core/check.h"

namespace rowland::diffraction {

MapUpload::MapUpload(std::shared_ptr<MapTexels> texels)
    : texels_(std::move(texels)), map_(texels_->desc, texels_->sampling, texels_->scale) {}

bool MapUpload::upload(int slices) {
    const gpu::TextureDesc& desc = texels_->desc;
    const int end = uploaded_ + std::min(std::max(1, slices), desc.depth - uploaded_);
    const std::size_t slice =
        std::size_t{4} * static_cast<std::size_t>(desc.width) * static_cast<std::size_t>(desc.height);
    map_.upload(
        std::span<const std::uint16_t>(texels_->halves)
            .subspan(static_cast<std::size_t>(uploaded_) * slice, static_cast<std::size_t>(end - uploaded_) * slice),
        {.layer = uploaded_, .layers = end - uploaded_});
    uploaded_ = end;
    if (uploaded_ < desc.depth) return false;
    texels_->halves = {};
    return true;
}

GpuMap MapUpload::take() {
    ROWLAND_CHECK_OP(uploaded_, ==, texels_->desc.depth);
    return std::move(map_);
}

}  // namespace rowland::diffraction
