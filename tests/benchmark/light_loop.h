#pragma once

#include <glm/mat3x3.hpp>
#include <vector>

#include "engine/gpu/texture.h"
#include "engine/render/material.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::benchmark {

/// Component: a grating that is evaluated directly.
struct LightLoop {};

/// What diffraction under many lights costs without any of the representations (Lindsay & Agu 2006, fig. 3): in every
/// pixel, for every directional light and every order, the one wavelength λ = d (s_g + v_g)/m and its colour:
/// XYZ = Σ_lights ½ s_n Σ_m (d/|m|) η_m(λ) cmf(λ) E(λ)ᵀ F. Flat lobe; the probe is left to the base.
class LightLoopType final : public render::MaterialType {
 public:
    LightLoopType(const diffraction::Grating& grating, const glm::dmat3& xyz_to_working);

    void add_shaders(gpu::ShaderLibrary& library) const override;
    bool owns(ecs::World& world, ecs::Entity entity) const override;
    gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity) const override;
    void update(ecs::World&, const render::FrameLight&) override {}
    void bind(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const override;

 private:
    float pitch_nm_;
    std::vector<int> orders_;
    gpu::Texture colours_;  ///< row 3k + c: XYZ of order k's light of colour c, one texel a nanometre from 380 to 780
    glm::mat3 working_to_rec709_;
    glm::vec3 mirror_weight_;
    glm::vec3 base_weight_;
};

}  // namespace rowland::benchmark
