#pragma once

#include "engine/lighting/lobe_nodes.h"

namespace rowland::lighting {

/// How far the lobes of the nodes' look-ups, weighted, are from the surface's lobe, the first by the angles at which
/// they are met: relative RMS over directions, of the lobe and of its products with the first three polynomials in
/// cos^0.7 that are orthogonal over it.
double lobe_misfit(double view_cosine, double roughness, const LobeNodes& nodes);

/// Leans and roughnesses that lessen it, from those given. Angles and weights stay.
LobeNodes refine_nodes(double view_cosine, double roughness, const LobeNodes& nodes);

/// The whole table, in a quarter of a minute on two processors. Texels beside each other have nodes that are alike, so
/// that values between them hold also.
LobeNodeTable fit_lobe_nodes();

}  // namespace rowland::lighting
