#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/ecs/world.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/framebuffer.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/probe_image.h"
#include "engine/platform/gl_context.h"
#include "engine/post/display_pass.h"
#include "engine/post/post_stack.h"
#include "engine/render/material.h"
#include "engine/render/renderer.h"
#include "engine/scene/camera.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::trade {

/// Shades a grating light by light and order by order, without SH: the comparison of Lindsay & Agu 2006, fig. 3. For
/// each light and order m, a pixel looks up the colour of the wavelength d u/m.
class LightLoop {
 public:
    /// Needs a current context. `xyz_to_working`: the renderer's. Throws Error (input) for a lobe that is not flat, a
    /// lattice, a cover, transmission, fewer than kManyGrooves grooves, and more than 64 orders other than 0.
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
    gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) const override;
    void update(ecs::World&, std::span<const render::FrameLight>, std::span<const render::LitEntity>) override {}
    void bind(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot,
              const gpu::Program& program) const override;
};

/// The disc of disc_mesh() on the GPU, lit by a probe. Needs a current context.
class Stage {
 public:
    /// `directional_light`: one lamp besides the probe.
    Stage(glm::ivec2 size, const scene::Camera& camera, bool directional_light);

    /// Gratings that shade key lights one by one use the probe's.
    void set_probe(const lighting::LightProbe& probe);
    void set_camera(const scene::Camera& camera) { camera_ = camera; }

    std::shared_ptr<const diffraction::GpuMaterial> upload(const diffraction::CookedMaterial& material) const;
    /// Shades the disc by the engine's own material, by a grating, or light by light.
    void show_plain();
    void show_grating(std::shared_ptr<const diffraction::GpuMaterial> material);
    void show_light_loop(std::shared_ptr<const LightLoop> loop);
    const glm::dmat3& xyz_to_working() const { return xyz_to_working_; }

    /// Draws a frame, waits until it is finished and returns its time, milliseconds. `effects`: with bloom, automatic
    /// exposure, vignette, display transform and dither.
    double draw(bool effects = false);
    /// A frame through the display transform alone: RGB, rows from the top.
    std::vector<std::uint8_t> picture(float exposure_stops);

    std::size_t vertices() const;

 private:
    void render() { renderer_.render(world_, camera_, target_); }
    void draw_effects(const post::PostSettings& settings);
    void clear_surface(bool use_key_lights);

    scene::Camera camera_;
    post::OcioConfig config_;
    glm::dmat3 xyz_to_working_;
    render::Renderer renderer_;
    gpu::Framebuffer target_;
    gpu::Framebuffer encoded_;
    gpu::ShaderLibrary post_shaders_;
    post::DisplayPass display_;
    post::PostStack post_stack_;
    ecs::World world_;
    ecs::Entity disc_;
    bool has_key_lights_ = false;
    std::uint32_t frame_ = 0;
};

/// A frame's time on this device: the minimum over rounds that alternate with the plain material.
struct FrameTime {
    double ms = 0.0;
    double plain_ms = 0.0;  ///< of the plain material without separate key lights; same mesh, camera and rounds
    std::optional<double> spread{};  ///< (median - minimum) / minimum of its frames; of two or more

    double ratio() const { return ms / plain_ms; }
};

/// Times frames of the stage's disc under one probe, in its own headless context.
class FrameTimer {
 public:
    /// `probe` must outlive it.
    FrameTimer(const lighting::ProbeImage& probe, glm::ivec2 size);

    FrameTime time(const diffraction::CookedMaterial& material, int key_lights);
    const std::string& device() const { return context_.renderer(); }

 private:
    void light_by(int key_lights);
    /// Milliseconds of frames after the warm-up.
    template <typename Show>
    std::vector<double> times(Show&& show);

    platform::HeadlessContext context_;
    const lighting::ProbeImage* image_;
    lighting::LightProbe probe_;
    std::map<int, std::vector<lighting::KeyLight>> fitted_;
    std::optional<int> lit_by_;
    Stage stage_;
};

}  // namespace rowland::trade
