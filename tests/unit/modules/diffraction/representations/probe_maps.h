#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/image/image.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_samples.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "tests/unit/modules/diffraction/gratings.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

/// What the tests of both maps measure: a map of the probe less its key lights, and the key lights by `direct`.
namespace rowland::diffraction::test {

struct OracleProbe {
    const char* name;
    const char* file;
    lighting::Mapping mapping;
    double tolerance;
};

/// A probe in two parts.
struct SplitProbe {
    std::vector<lighting::KeyLight> keys;
    lighting::LightSamples texels;
};

inline SplitProbe split(const std::filesystem::path& path, lighting::Mapping mapping, int count) {
    const lighting::ProbeImage probe(image::load_image(path), mapping, path.string());
    std::vector<lighting::KeyLight> keys = lighting::fit_key_lights(probe, count);
    lighting::LightSamples texels = lighting::light_samples(probe, keys);
    return {std::move(keys), std::move(texels)};
}

/// All of a frame set's light: sample(map, frame) + key lights.
template <typename Map>
std::vector<glm::dvec3> radiance(const Map& map, const KernelTable& kernel, const std::vector<lighting::KeyLight>& keys,
                                 const std::vector<ShadingPoint>& frames) {
    std::vector<glm::dvec3> xyz;
    for (const ShadingPoint& frame : frames)
        xyz.push_back(sample(map, frame) + direct_radiance(kernel, {compact_disc().pitch_nm},
                                                           std::span<const lighting::KeyLight>(keys), frame));
    return xyz;
}

}  // namespace rowland::diffraction::test
