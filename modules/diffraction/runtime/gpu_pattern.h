#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/key_lights.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/bake/pattern_picture.h"

namespace rowland::diffraction {

/// A lattice's diffraction pattern for analytic lights and key lights: shaders/pattern.glsl.
class GpuPattern {
 public:
    /// `xyz_to_working`: of the engine's lights, which come in the working space.
    GpuPattern(const Material& material, const glm::dmat3& xyz_to_working);

    /// Computes and uploads pictures when a program first reads them, and when the lights' colours or the key lights
    /// change, but for their directions. `light_colours`: see SurfaceLight.
    void bind(const gpu::Program& program, std::span<const lighting::KeyLight> key_lights,
              std::span<const glm::vec3> light_colours) const;

 private:
    void upload_colours(std::span<const glm::vec3> light_colours) const;
    void upload_key_lights(std::span<const lighting::KeyLight> key_lights) const;

    Grating grating_;
    colour::Illuminant illuminant_;
    glm::dmat3 xyz_to_working_;
    mutable std::optional<PatternPicture> picture_;  ///< in the working space, its largest component 1
    mutable float largest_ = 1.0F;
    mutable std::optional<gpu::Texture> texture_;
    mutable std::vector<glm::vec3> colours_;  ///< of its layers
    mutable std::optional<gpu::Texture> lobe_texture_;
    mutable std::vector<lighting::KeyLight> key_lights_;  ///< of its layers
    mutable glm::vec4 lobe_scale_{0.0F};
};

}  // namespace rowland::diffraction
