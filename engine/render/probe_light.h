#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/light_texels.h"
#include "engine/lighting/packed_light.h"
#include "engine/lighting/sh_light.h"
#include "engine/render/shaders/key_light_block.h"

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
    /// SH of irradiance/π of the residual, linear Rec.709.
    const std::array<glm::dvec3, 9>& ambient() const { return ambient_; }

 private:
    lighting::ShLight sh_;
    lighting::PackedLight packed_;
    std::vector<lighting::KeyLight> fitted_;
    std::array<glm::dvec3, 9> whole_ambient_ = {};

    std::vector<lighting::KeyLight> key_lights_;
    lighting::ShLight residual_;
    std::shared_ptr<const lighting::LightTexels> texels_;
    std::array<glm::dvec3, 9> ambient_ = {};
};

/// Key lights, at most ROWLAND_MAXIMUM_KEY_LIGHTS, as shaders read them.
KeyLightBlock key_light_block(std::span<const lighting::KeyLight> keys, const glm::dmat3& rec709_to_working);

}  // namespace rowland::render
