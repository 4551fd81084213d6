#pragma once

#include "engine/render/shadow_fit.h"

namespace rowland::render {

/// The half-shadow of a light that is a disc: percentage-closer soft shadows (Fernando 2005). The mean depth of what
/// blocks the light about a point gives the width over which comparisons with the shadow map are averaged, as by
/// similar triangles; a tilted surface is compared with its own plane. Exact under one straight edge; where several
/// blockers lie at different depths, one mean stands for all.
///
/// Radius of the mean, in widths of the map, for a blocker that is the map's whole depth away.
/// `angular_radius`: of the light, radians; `size`: of the map, texels.
float penumbra_over_depth(const ShadowView& view, int size, float angular_radius);

}  // namespace rowland::render
