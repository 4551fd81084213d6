#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "editor/inspector/document.h"
#include "editor/inspector/preview_object.h"
#include "engine/core/computed.h"
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

/// The grating of each material; null where there is none, or none yet.
using Gratings = std::vector<std::shared_ptr<const CookedGrating>>;

/// Cooks the gratings of one document. The tables do not depend on the rotation of the grooves and are baked once.
/// May be used from several threads at once.
class GratingCook {
 public:
    /// `scene` holds the groove textures; null for a material file.
    explicit GratingCook(std::shared_ptr<const SceneObject> scene) : scene_(std::move(scene)) {}

    /// Takes seconds. Throws Error (input) if the grating cannot be drawn.
    std::shared_ptr<const CookedGrating> cook(const MaterialSource& source);

 private:
    std::shared_ptr<const diffraction::GrooveMap> groove_map(const MaterialSource& source) const;
    std::shared_ptr<const diffraction::CookedMaterial> baked(const diffraction::Material& material,
                                                             const std::string& key);

    std::shared_ptr<const SceneObject> scene_;
    std::mutex lock_;
    std::map<std::string, std::weak_ptr<const diffraction::CookedMaterial>> baked_;  ///< by bake_key()
};

/// The cooked gratings of all materials of a scene. The chosen one is given; the others are cooked here, in the
/// background, once each.
class SceneGratings {
 public:
    using Source = std::shared_ptr<const MaterialSource>;
    using Grating = std::shared_ptr<const CookedGrating>;

    /// Removes the gratings of the last document.
    void reset();
    /// Call it every frame. `chosen`: the cooked grating of the chosen material; null while it is not cooked. Returns
    /// whether a grating is new.
    bool update(const Document& document, const std::shared_ptr<GratingCook>& cook, const Grating& chosen);

    /// An edited grating stays until its successor is cooked.
    const Gratings& all() const { return all_; }
    bool busy() const { return others_.busy(); }
    /// The failures since the last call.
    std::vector<std::string> take_failures() { return std::exchange(failures_, {}); }

 private:
    void want_others(const Document& document, const std::shared_ptr<GratingCook>& cook);

    /// Results so far, with their sources.
    struct Cooked {
        std::vector<Source> sources;
        Gratings gratings;
        std::vector<std::string> failures;
    };

    Gratings all_;
    std::vector<Source> sources_;  ///< of all_
    std::vector<std::string> failures_;
    Computed<std::vector<Source>, Cooked> others_;
};

}  // namespace rowland::inspector
