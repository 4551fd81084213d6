#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_samples.h"
#include "engine/lighting/probe_image.h"
#include "engine/render/material.h"

namespace rowland::diffraction {

/// A smooth probe: no radiance is below 0, nor does it change within a few texels.
lighting::ProbeImage smooth_probe();

/// Three key lights, from wide to narrow.
std::vector<lighting::KeyLight> three_keys();

/// A frame's light, and what references on the CPU read of it.
struct GratingLight {
    std::shared_ptr<const lighting::LightProbe> probe = {};
    std::vector<lighting::KeyLight> key_lights = {};
    lighting::ShLight sh = {};                                        ///< the whole probe
    lighting::ShLight residual = {};                                  ///< without `key_lights`
    std::shared_ptr<const lighting::LightSamples> probe_texels = {};  ///< the whole probe
    std::shared_ptr<const lighting::LightSamples> texels = {};        ///< without `key_lights`
    std::uint64_t version = 0;

    render::FrameLight frame() const { return {.probe = probe, .analytic_key_lights = true, .version = version}; }
};

/// A probe with key lights added to it.
GratingLight light_of(const lighting::ProbeImage& probe, std::vector<lighting::KeyLight> keys,
                      std::uint64_t version = 1);

/// A probe without any light.
GratingLight black_light();

}  // namespace rowland::diffraction
