#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "editor/inspector/material_source.h"
#include "editor/inspector/scene_object.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/runtime/groove_map.h"

namespace rowland::inspector {

/// A grating as the preview draws it. Never changes, so the pointer to it is its identity.
struct CookedGrating {
    std::shared_ptr<const diffraction::CookedMaterial> material;
    std::shared_ptr<const diffraction::GrooveMap> grooves;  ///< null: none
    double groove_rotation = 0.0;                           ///< radians
    bool has_base = true;                                   ///< false: the base is the scene's surface
};

/// Cooks the gratings of one document. Equal gratings share their tables, however their grooves are turned. For any
/// number of threads.
class GratingCook {
 public:
    /// `scene`: whose textures the grooves may have; null: a material file's.
    explicit GratingCook(std::shared_ptr<const SceneObject> scene) : scene_(std::move(scene)) {}

    /// Takes seconds. Throws Error (input) if the grating cannot be drawn.
    std::shared_ptr<const CookedGrating> cook(const MaterialSource& source);

 private:
    std::shared_ptr<const diffraction::GrooveMap> groove_map(const MaterialSource& source) const;
    std::shared_ptr<const diffraction::CookedMaterial> baked(const diffraction::Material& material,
                                                             const std::string& key);

    std::shared_ptr<const SceneObject> scene_;
    std::mutex lock_;
    std::map<std::string, std::weak_ptr<const diffraction::CookedMaterial>> baked_;  ///< by the extension's text
};

}  // namespace rowland::inspector
