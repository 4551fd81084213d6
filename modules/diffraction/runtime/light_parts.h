#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/lighting/light_samples.h"
#include "engine/render/material.h"

namespace rowland::diffraction {

/// The distant light of a frame in the forms that gratings need, linear Rec.709, world axes: as `sh`, or as the sum of
/// `residual`, `key_lights` and the scene's directional lights.
struct LightParts {
    lighting::ShLight sh;                                        ///< raw radiance: the probe and the directional lights
    lighting::ShLight probe_sh;                                  ///< the probe alone
    lighting::ShLight residual;                                  ///< the probe without `key_lights`
    std::vector<lighting::KeyLight> key_lights;                  ///< those that are shaded as analytic lights
    std::shared_ptr<const lighting::LightSamples> probe_texels;  ///< the probe alone, at full resolution
    std::shared_ptr<const lighting::LightSamples> texels;        ///< the same without `key_lights`
    std::shared_ptr<const lighting::PackedLight> packed;         ///< what `probe_texels` are unpacked from
    std::string illuminant = colour::d65().name;                 ///< name of the spectrum of the probe's white
    std::vector<glm::vec3> light_strengths;                      ///< see render::FrameLight; not part of `version`
    std::uint64_t version = 0;
};

/// Derives the parts from the engine's light, each when what it depends on changes.
class LightDivision {
 public:
    const LightParts& of(const render::FrameLight& light);

 private:
    std::shared_ptr<const lighting::LightProbe> probe_;
    bool key_lights_apart_ = false;
    LightParts parts_;
};

/// Adds distant lights to raw radiance: L(s) = E δ(s − d), so l_i += E Y_i(d).
void add_distant_lights(std::span<const render::DistantLight> lights, lighting::ShLight& sh);

}  // namespace rowland::diffraction
