#pragma once

#include <functional>
#include <vector>

namespace rowland::lighting {

/// How the angles of incidence on a rough surface's microfacets are distributed, for a view: weights of equal steps of
/// √cos, which sum to 1.
std::vector<double> lobe_angles(double view_cosine, double roughness, int steps);

/// What a lobe reflects of even light if its microfacets reflect everything.
double lobe_albedo(double view_cosine, double roughness);

/// Calls f(cosine on the microfacet, weight) for the sampled half vectors of a GGX lobe whose light comes from above
/// the surface. The weights are those of the split sum (engine/render/brdf_table.h), each sample's over their number.
/// `roughness`: perceptual.
void sample_lobe(double view_cosine, double roughness, const std::function<void(double, double)>& f);

}  // namespace rowland::lighting
