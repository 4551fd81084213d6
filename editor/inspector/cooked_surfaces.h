#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "editor/inspector/document.h"
#include "editor/inspector/preview_object.h"
#include "engine/core/computed.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/runtime/groove_map.h"
#include "modules/thin_film/asset/film_material.h"
#include "modules/thin_film/asset/gltf_iridescence.h"

namespace rowland::inspector {

/// A film as the preview draws it.
struct DrawnFilm {
    std::shared_ptr<const thin_film::CookedFilm> cooked = {};   ///< null: a scene's film that is not drawn
    std::optional<thin_film::GltfIridescence> in_scene = {};    ///< of a scene's material
    std::shared_ptr<const scene::ImportedScene> textures = {};  ///< of `in_scene`
};

/// A grating or a film as the preview draws it. Never changes, so the pointer to it is its identity.
struct CookedSurface {
    std::shared_ptr<const diffraction::CookedMaterial> material = {};  ///< null: a film
    std::shared_ptr<const diffraction::GrooveMap> grooves = {};        ///< null: none
    double groove_rotation = 0.0;                                      ///< radians
    bool has_base = true;                                              ///< false: the base is the scene's surface
    std::optional<DrawnFilm> film = {};                                ///< nullopt: a grating
};

/// The surface of each material; null where there is none, or none yet.
using CookedSurfaces = std::vector<std::shared_ptr<const CookedSurface>>;

/// Cooks the gratings and films of one document. The tables do not depend on the rotation of the grooves or the factor
/// of a film, so an edit of these does not bake them again. May be used from several threads at once.
class SurfaceCook {
 public:
    /// `scene` holds the textures; null for a material file.
    explicit SurfaceCook(std::shared_ptr<const SceneObject> scene) : SurfaceCook(std::move(scene), nullptr) {}
    /// Shares the tables that `other` has baked; null: none.
    SurfaceCook(std::shared_ptr<const SceneObject> scene, const SurfaceCook* other)
        : scene_(std::move(scene)), tables_(other != nullptr ? other->tables_ : std::make_shared<Tables>()) {}

    /// `material`: its index in the scene. Takes seconds. Throws Error (input) if the surface cannot be drawn.
    std::shared_ptr<const CookedSurface> cook(const MaterialSource& source, std::size_t material = 0);

 private:
    template <typename Cooked>
    using Baked = std::map<std::string, std::weak_ptr<const Cooked>>;

    CookedSurface cook_grating(const diffraction::GltfGrating& grating, const MaterialSource& source);
    DrawnFilm cook_film(const MaterialSource& source, std::size_t material);
    std::shared_ptr<const scene::ImportedScene> textures_of(const MaterialSource& source) const;
    template <typename Cooked, typename Bake>
    std::shared_ptr<const Cooked> baked(Baked<Cooked>& all, const std::string& key, const Bake& bake);

    struct Tables {
        std::mutex lock;
        Baked<diffraction::CookedMaterial> gratings;  ///< by their inputs
        Baked<thin_film::CookedFilm> films;           ///< likewise
    };

    std::shared_ptr<const SceneObject> scene_;
    std::shared_ptr<Tables> tables_;
};

/// The cooked gratings and films of all materials of a scene. That of the chosen material is passed to update(); the
/// others are cooked here, in the background.
class SceneSurfaces {
 public:
    using Source = std::shared_ptr<const MaterialSource>;
    using Surface = std::shared_ptr<const CookedSurface>;

    /// Removes the surfaces of the last document.
    void reset();
    /// Call it every frame. `chosen`: the cooked surface of the chosen material; null while it is not cooked. Returns
    /// whether a surface is new.
    bool update(const Document& document, const std::shared_ptr<SurfaceCook>& cook, const Surface& chosen);

    /// An edited surface stays until its successor is cooked.
    const CookedSurfaces& all() const { return all_; }
    bool busy() const { return others_.busy(); }
    /// The failures since the last call.
    std::vector<std::string> take_failures() { return std::exchange(failures_, {}); }

 private:
    void want_others(const Document& document, const std::shared_ptr<SurfaceCook>& cook);

    /// Results so far, with their sources.
    struct Cooked {
        std::vector<Source> sources;
        CookedSurfaces surfaces;
        std::vector<std::string> failures;
    };

    CookedSurfaces all_;
    std::vector<Source> sources_;  ///< of all_
    std::vector<std::string> failures_;
    Computed<std::vector<Source>, Cooked> others_;
};

}  // namespace rowland::inspector
