#include "content/demo/looks/variants.h"

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/log.h"

namespace rowland::demo {

Variants::Variants(const glm::dmat3& xyz_to_working) : xyz_to_working_(xyz_to_working) {}

GpuMaterialPointer Variants::find(const GpuMaterialPointer& own,
                                  const std::shared_ptr<const diffraction::GrooveMap>& grooves, bool flat,
                                  const Look& look) {
    if (look.own()) return own;
    for (const Variant& variant : variants_)
        if (variant.own.lock() == own && variant.grooves == grooves && variant.look == look) return variant.uploaded;
    Variant& variant = variants_.emplace_back();
    variant.own = own;
    variant.grooves = grooves;
    variant.look = look;
    const auto material = with_look({.material = own->cooked()->material, .flat = flat, .grooves = grooves}, look);
    if (material) variant.baked = background_.run([wanted = *material] { return diffraction::bake_material(wanted); });
    return nullptr;
}

void Variants::poll() {
    for (Variant& variant : variants_) {
        if (!is_ready(variant.baked)) continue;
        try {
            variant.uploaded = diffraction::make_gpu_material(variant.baked.get(), xyz_to_working_);
        } catch (const Error& error) {
            log_error("{}: {}", look_name(variant.look), error.what());
        }
    }
    std::erase_if(variants_, [](const Variant& variant) { return variant.own.expired() && !variant.baked.valid(); });
}

bool Variants::baking() const {
    return std::any_of(variants_.begin(), variants_.end(),
                       [](const Variant& variant) { return variant.baked.valid(); });
}

}  // namespace rowland::demo
