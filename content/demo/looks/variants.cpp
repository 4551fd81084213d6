#include "content/demo/looks/variants.h"

#include <algorithm>
#include <utility>

#include "engine/core/log.h"

namespace rowland::demo {

GpuMaterialPointer Variants::find(const GpuMaterialPointer& own,
                                  const std::shared_ptr<const diffraction::GrooveMap>& grooves, bool flat,
                                  const Look& look) {
    if (look.own()) return own;
    for (const auto& variant : variants_)
        if (variant->own.lock() == own && variant->grooves == grooves && variant->look == look)
            return variant->uploaded;
    const LookSubject subject{.material = own->cooked()->material, .flat = flat, .grooves = grooves};
    variants_.push_back(std::make_shared<Variant>(
        Variant{.own = own, .grooves = grooves, .look = look, .material = with_look(subject, look), .uploaded = {}}));
    return nullptr;
}

void Variants::poll() {
    const auto change = baked_.poll();
    if (change.value) running_->uploaded = diffraction::make_gpu_material(*baked_.value(), xyz_to_working_);
    if (!change.failure.empty()) log_error("{}: {}", look_name(running_->look), change.failure);
    if (change.value || !change.failure.empty()) running_ = nullptr;
    std::erase_if(variants_, [](const auto& variant) { return variant->own.expired(); });
    if (running_) return;
    const auto next = std::ranges::find_if(variants_, [](const auto& v) { return v->material.has_value(); });
    if (next == variants_.end()) return;
    running_ = *next;
    baked_.want(running_, [material = *std::exchange(running_->material, std::nullopt)](const auto&, const auto&) {
        return std::optional(diffraction::bake_material(material));
    });
}

bool Variants::baking() const {
    return running_ != nullptr ||
           std::ranges::any_of(variants_, [](const auto& variant) { return variant->material.has_value(); });
}

}  // namespace rowland::demo
