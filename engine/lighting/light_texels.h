#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "engine/lighting/probe_image.h"

namespace rowland::lighting {

/// A probe as a list of small lights, one array a component: for sums over directions that count every texel's area
/// once. All arrays have one length.
struct LightTexels {
    std::vector<float> x, y, z;           ///< unit directions, world axes
    std::vector<float> red, green, blue;  ///< flux: radiance × solid angle. May be negative (see light_texels())

    std::size_t size() const { return x.size(); }
};

/// Texels of more than this side, in radians, are cut up, with the bilinear lookup's radiance in the parts.
inline constexpr double kTexelSide = 0.0065;

/// All texels of a probe, less the lobes: `keys` light as much as is taken out here, flux for flux.
/// Does not depend on the number of threads. A 1024 × 512 probe has 12 MB.
LightTexels light_texels(const ProbeImage& probe, std::span<const KeyLight> keys = {},
                         double largest_side = kTexelSide);

/// The same light in fewer pieces: one for each texel of a cube map of `face_size` texels a side that holds any, at the
/// centroid of what it holds, weighted by the magnitude of flux; a compact lamp keeps its place.
LightTexels gather_texels(const LightTexels& texels, int face_size);

}  // namespace rowland::lighting
