#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/runtime/groove_map.h"

namespace rowland::demo {

enum class Detail { Coarse, Medium, Fine };
const char* detail_name(Detail detail);

/// A representation to compare a grating in.
struct Look {
    std::string representation;  ///< its name in material files; empty: the material's own
    Detail detail = Detail::Medium;

    bool own() const { return representation.empty(); }
    friend bool operator==(const Look&, const Look&) = default;
};

/// "as cooked", or "arc, fine".
std::string look_name(const Look& look);
/// Its inverse; nullopt for another text. Recordings of earlier versions say "usual" for "medium".
std::optional<Look> look_named(std::string name);

struct LookSubject {
    diffraction::Material material;
    bool flat = false;                                                ///< the mesh lies in a plane
    std::shared_ptr<const diffraction::GrooveMap> grooves = nullptr;  ///< varies the grating over the surface
};

/// The material with the look's settings in place of its own; nullopt if they do not suit its grating or the object.
std::optional<diffraction::Material> with_look(const LookSubject& subject, const Look& look);

/// The material's own look, then all that suit the object, in one detail.
std::vector<Look> looks_of(const LookSubject& subject, Detail detail);

/// The one after `look` among looks_of() its detail, the first after the last.
Look next_representation(const LookSubject& subject, const Look& look);
/// The next detail of the same representation; coarse after fine.
Look next_detail(const Look& look);

}  // namespace rowland::demo
