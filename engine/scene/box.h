#pragma once

#include "engine/scene/mesh.h"

namespace rowland::scene {

/// A box on the XZ plane around the origin: tables, blocks, cards, rules. Its vertical edges may be rounded, and the
/// edges of its top and bottom bevelled at 45°.
struct BoxRecipe {
    double width = 0.0;          ///< metres along X, > 0
    double height = 0.0;         ///< along Y, > 0
    double depth = 0.0;          ///< along Z, > 0
    double corner_radius = 0.0;  ///< at most half the width and half the depth
    int corner_steps = 8;        ///< facets of a round corner, 1 … 256
    double bevel = 0.0;          ///< less than half of each size, and than the corner radius unless that is 0
    bool top = true;             ///< which faces to build; bevels belong to the sides
    bool sides = true;
    bool bottom = true;
};

/// Top and bottom have tangent +X and planar uvs: u = 0 … 1 across the width, v across the depth, towards −Z on top and
/// +Z on the bottom. On the sides the tangent runs counter-clockwise seen from above, as u does; v grows upwards.
Mesh build_box(const BoxRecipe& recipe);

}  // namespace rowland::scene
