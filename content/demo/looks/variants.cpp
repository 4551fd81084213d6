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
    if (auto outcome = bake_.poll()) {
        if (outcome->value)
            running_->uploaded = diffraction::make_gpu_material(std::move(*outcome->value), xyz_to_working_);
        else
            log_error("{}: {}", look_name(running_->look), outcome->failure);
        running_ = nullptr;
    }
    std::erase_if(variants_, [](const auto& variant) { return variant->own.expired(); });
    if (running_) return;
    const auto next =
        std::ranges::find_if(variants_, [](const auto& variant) { return variant->material.has_value(); });
    if (next == variants_.end()) return;
    running_ = *next;
    bake_.start([material = *std::exchange(running_->material, std::nullopt)](const std::stop_token&) {
        return diffraction::bake_material(material);
    });
}

bool Variants::baking() const {
    return running_ != nullptr ||
           std::ranges::any_of(variants_, [](const auto& variant) { return variant->material.has_value(); });
}

}  // namespace rowland::demo
