#pragma once

#include <future>
#include <glm/mat3x3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "content/demo/looks/background.h"
#include "content/demo/looks/look.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::demo {

using GpuMaterialPointer = std::shared_ptr<const diffraction::GpuMaterial>;

/// Materials in other looks than their own, baked beside the frames when they are first asked for and kept as long as
/// the material they are made from lives. Needs the context that was current when it was made.
class Variants {
 public:
    /// `xyz_to_working` as the renderer's.
    explicit Variants(const glm::dmat3& xyz_to_working);

    /// `own` in that look; null while it is baked, and where it does not suit the object. `grooves` and `flat` as in
    /// LookSubject.
    GpuMaterialPointer find(const GpuMaterialPointer& own, const std::shared_ptr<const diffraction::GrooveMap>& grooves,
                            bool flat, const Look& look);
    /// Once a frame: uploads what was baked, forgets what nobody needs any more.
    void poll();
    bool baking() const;
    const glm::dmat3& xyz_to_working() const { return xyz_to_working_; }

 private:
    struct Variant {
        std::weak_ptr<const diffraction::GpuMaterial> own;
        std::shared_ptr<const diffraction::GrooveMap> grooves;
        Look look;
        std::future<diffraction::CookedMaterial> baked;  ///< valid while it is awaited
        GpuMaterialPointer uploaded;                     ///< null also where the look does not suit
    };

    glm::dmat3 xyz_to_working_;
    std::vector<Variant> variants_;
    Background background_;
};

}  // namespace rowland::demo
