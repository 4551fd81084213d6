#pragma once

#include "engine/lighting/lobe_nodes.h"

namespace rowland::lighting {

/// Error of the weighted sum of the nodes' look-up lobes against the surface's lobe: relative RMS over directions, of
/// the lobe and of its products with the first three LobePolynomials.
double lobe_misfit(double view_cosine, double roughness, const LobeNodes& nodes);

/// Fits leans and roughnesses, starting from the given ones. Angles and weights stay.
LobeNodes refine_nodes(double view_cosine, double roughness, const LobeNodes& nodes);

/// The whole table, in a quarter of a minute on two processors. Neighbouring texels have similar nodes, so values
/// interpolated between them are valid as well.
LobeNodeTable fit_lobe_nodes();

}  // namespace rowland::lighting
