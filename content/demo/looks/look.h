#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/runtime/groove_map.h"

namespace rowland::demo {

enum class Detail { Coarse, Usual, Fine };
const char* detail_name(Detail detail);

/// How a grating is shown for the sake of comparison.
struct Look {
    std::string representation;  ///< its name in material files; empty: as the material itself says
    Detail detail = Detail::Usual;

    bool own() const { return representation.empty(); }
    friend bool operator==(const Look&, const Look&) = default;
};

/// "as cooked", or "arc, fine".
std::string look_name(const Look& look);
/// Its inverse; nothing for another text.
std::optional<Look> look_named(std::string_view name);

/// What a look is baked from: the grating of an object, and what of the object it depends on.
struct LookSubject {
    diffraction::Material material;
    bool flat = false;                                                ///< the mesh lies in a plane
    std::shared_ptr<const diffraction::GrooveMap> grooves = nullptr;  ///< varies the grating over the surface
};

/// The material with a look's settings in place of its own; nothing where the module's parser refuses them for this
/// grating, or they do not suit the object.
std::optional<diffraction::Material> with_look(const LookSubject& subject, const Look& look);

/// The material's own look, then those that suit the object, in one detail.
std::vector<Look> looks_of(const LookSubject& subject, Detail detail);

/// The one after `look` among looks_of() its detail, the first after the last.
Look next_representation(const LookSubject& subject, const Look& look);
/// The next detail of the same representation; coarse after fine.
Look next_detail(const Look& look);

}  // namespace rowland::demo
