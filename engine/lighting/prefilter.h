#pragma once

#include "engine/lighting/environment_map.h"
#include "engine/lighting/probe_image.h"

namespace rowland::lighting {

struct PrefilterSettings {
    int face_size = 256;  ///< power of two in [16, 1024]; lowered to the probe's resolution
};

/// The cube map a probe is prefiltered into: faces of about half an equirectangular image's height (a quarter of an
/// angular map's) and at most 5/4 of that, a power of two, at least 16; levels down to faces of 4 texels.
CubeLayout environment_layout(const ProbeImage& probe, const PrefilterSettings& settings);

/// Level 0: the probe's mean over each texel. Level k: radiance under the GGX lobe of that level's roughness, with view
/// = normal = reflection [Karis 2013, split sum], weights normalised so that a constant probe stays constant. Does
/// not depend on the number of threads.
EnvironmentMap prefilter(const ProbeImage& probe, const PrefilterSettings& settings = {});

}  // namespace rowland::lighting
