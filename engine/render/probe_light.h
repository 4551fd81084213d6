#pragma once

#include <array>
#include <memory>
#include <vector>

#include "engine/lighting/environment_map.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/light_texels.h"
#include "engine/lighting/packed_light.h"
#include "engine/lighting/sh_light.h"

namespace rowland::render {

/// A probe's light as frames divide it: with key lights into those and what they leave, else one whole. The parts sum
/// to the probe in either case.
class ProbeLight {
 public:
    ProbeLight() = default;
    /// Keeps what it needs of the probe; divides nothing yet.
    explicit ProbeLight(const lighting::LightProbe& probe);

    /// Divides the light; `with_keys`: whether the probe's key lights are taken out of the rest.
    void divide(bool with_keys);

    const lighting::ShLight& sh() const { return sh_; }  ///< of all of it
    const std::vector<lighting::KeyLight>& key_lights() const { return key_lights_; }
    const lighting::ShLight& residual() const { return residual_; }
    const std::shared_ptr<const lighting::LightTexels>& texels() const { return texels_; }
    /// Of all of it.
    const std::shared_ptr<const lighting::LightTexels>& whole_texels() const { return whole_texels_; }
    /// The whole probe: level 0 of its environment.
    const std::shared_ptr<const lighting::PackedEnvironmentMap>& radiance() const { return radiance_; }
    /// SH of irradiance/π of the residual, linear Rec.709.
    const std::array<glm::dvec3, 9>& ambient() const { return ambient_; }

 private:
    lighting::ShLight sh_;
    lighting::PackedLight packed_;
    std::vector<lighting::KeyLight> fitted_;
    std::shared_ptr<const lighting::PackedEnvironmentMap> radiance_;
    std::array<glm::dvec3, 9> whole_ambient_ = {};

    std::vector<lighting::KeyLight> key_lights_;
    lighting::ShLight residual_;
    std::shared_ptr<const lighting::LightTexels> texels_;
    std::shared_ptr<const lighting::LightTexels> whole_texels_;
    std::array<glm::dvec3, 9> ambient_ = {};
};

}  // namespace rowland::render
