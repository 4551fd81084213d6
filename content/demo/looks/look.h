#pragma once

#include <glm/mat3x3.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/computed.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/groove_map.h"

namespace rowland::demo {

enum class Detail { Coarse, Medium, Fine };
const char* detail_name(Detail detail);

/// The representation that draws a grating, and its level of detail.
struct Look {
    std::string representation;  ///< its name in material files; empty: the material's own
    Detail detail = Detail::Medium;

    bool own() const { return representation.empty(); }
    friend bool operator==(const Look&, const Look&) = default;
};

/// "as cooked", or "arc, fine".
std::string look_name(const Look& look);
/// Its inverse; nullopt for another text. Recordings of earlier versions say "usual" for "medium".
std::optional<Look> parse_look(std::string name);

struct LookSubject {
    diffraction::Material material;
    bool flat = false;                                                ///< the mesh lies in a plane
    std::shared_ptr<const diffraction::GrooveMap> grooves = nullptr;  ///< varies the grating over the surface
};

/// The material with the look's settings in place of its own; nullopt if they do not suit its grating or the object.
std::optional<diffraction::Material> apply_look(const LookSubject& subject, const Look& look);

/// The material's own look, then all that suit the object, in one detail.
std::vector<Look> suitable_looks(const LookSubject& subject, Detail detail);

/// The look after `look` among the suitable_looks() of its detail; after the last one, the first.
Look next_representation(const LookSubject& subject, const Look& look);
/// The next detail of the same representation; coarse after fine.
Look next_detail(const Look& look);

using GpuMaterialPointer = std::shared_ptr<const diffraction::GpuMaterial>;

/// Materials in other looks than their own. Each is baked in the background when it is first asked for, one at a time,
/// and kept as long as the material it is made from. Needs the context that was current at construction.
class Variants {
 public:
    /// `xyz_to_working` as the renderer's.
    explicit Variants(const glm::dmat3& xyz_to_working) : xyz_to_working_(xyz_to_working) {}

    /// `own` in that look; null while it is baked, and if the look does not suit it. `grooves` and `flat` as in
    /// LookSubject.
    GpuMaterialPointer find_or_bake(const GpuMaterialPointer& own,
                                    const std::shared_ptr<const diffraction::GrooveMap>& grooves, bool flat,
                                    const Look& look);
    /// To be called once per frame: uploads what was baked, starts the next bake, and drops variants of materials that
    /// no longer exist.
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
