#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/texture.h"
#include "engine/render/material.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::trade {

/// A grating that is shaded light by light and order by order, without SH: the comparison of Lindsay & Agu 2006,
/// fig. 3. Each pixel looks up the colour of the wavelength d u/m for each light and order m.
class LightLoop {
 public:
    /// Needs a current context. `xyz_to_working`: the renderer's. Throws Error (input) for a lobe that is not flat, and
    /// for fewer than kManyGrooves grooves.
    LightLoop(const diffraction::Grating& grating, const colour::LightSpectra& spectra,
              const glm::dmat3& xyz_to_working);

    /// Replaces the lights, of any number. Linear Rec.709.
    void set_lights(std::span<const render::DistantLight> lights);

    void bind(const gpu::Program& program) const;
    int orders() const { return static_cast<int>(orders_.size()); }

 private:
    double pitch_nm_;
    glm::vec3 mirror_weight_;  ///< of the layers that the engine shades, working space
    glm::vec3 base_weight_;
    std::vector<float> orders_;  ///< without 0
    gpu::Texture colours_;       ///< row 3 i + c: light of colour c in order i, one texel per nanometre from 380 to 780
    gpu::Buffer lights_;
    int light_count_ = 0;
};

/// Component: a surface that a light loop shades.
struct LightLoopSurface {
    std::shared_ptr<const LightLoop> loop;
};

/// Draws entities that have a LightLoopSurface; their StandardMaterial is the grating's base.
class LightLoopType final : public render::MaterialType {
 public:
    std::string name() const override { return "light loop"; }
    void add_shaders(gpu::ShaderLibrary& library) const override;
    bool owns(ecs::World& world, ecs::Entity entity) const override;
    gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity) const override;
    void update(ecs::World&, const render::FrameLight&) override {}
    void bind(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const override;
};

}  // namespace rowland::trade
