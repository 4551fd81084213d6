#pragma once

#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

#include "content/demo/looks/look.h"
#include "engine/core/computed.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::demo {

using GpuMaterialPointer = std::shared_ptr<const diffraction::GpuMaterial>;

/// Materials in other looks than their own. Each is baked in the background when it is first asked for, one after the
/// other, and kept as long as the material it is made from. Needs the context that was current at construction.
class Variants {
 public:
    /// `xyz_to_working` as the renderer's.
    explicit Variants(const glm::dmat3& xyz_to_working) : xyz_to_working_(xyz_to_working) {}

    /// `own` in that look; null while it is baked, and if the look does not suit it. `grooves` and `flat` as in
    /// LookSubject.
    GpuMaterialPointer find(const GpuMaterialPointer& own, const std::shared_ptr<const diffraction::GrooveMap>& grooves,
                            bool flat, const Look& look);
    /// To be called once per frame: uploads what was baked, starts the next bake, and drops unused variants.
    void poll();
    bool baking() const;
    const glm::dmat3& xyz_to_working() const { return xyz_to_working_; }

 private:
    struct Variant {
        std::weak_ptr<const diffraction::GpuMaterial> own;
        std::shared_ptr<const diffraction::GrooveMap> grooves;
        Look look;
        std::optional<diffraction::Material> material;  ///< to be baked
        GpuMaterialPointer uploaded;
    };

    glm::dmat3 xyz_to_working_;
    std::vector<std::shared_ptr<Variant>> variants_;
    std::shared_ptr<Variant> running_;
    Computed<std::shared_ptr<Variant>, diffraction::CookedMaterial> baked_;  ///< of running_
};

}  // namespace rowland::demo
