#pragma once

#include "engine/scene/mesh.h"
#include "modules/diffraction/foil/recipe.h"

namespace rowland::diffraction::foil {

/// A card about the origin, in metres: its front faces +Z, +Y is up.
struct CardMesh {
    scene::Mesh front;  ///< flat; u grows along +X, v down; the tangent is +X
    scene::Mesh back;   ///< the same, seen from behind
    scene::Mesh edge;   ///< u grows around the card, the tangent follows it
};
CardMesh card_mesh(const CardShape& shape);

}  // namespace rowland::diffraction::foil
