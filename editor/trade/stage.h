#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "editor/trade/light_loop.h"
#include "engine/ecs/world.h"
#include "engine/gpu/framebuffer.h"
#include "engine/lighting/light_probe.h"
#include "engine/post/display_pass.h"
#include "engine/post/post_stack.h"
#include "engine/render/renderer.h"
#include "engine/scene/camera.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::trade {

/// The disc of picture_scene.h on the GPU, lit by a probe. Needs a current context.
class Stage {
 public:
    /// `directional_light`: one lamp besides the probe.
    Stage(glm::ivec2 size, const scene::Camera& camera, bool directional_light);

    /// Gratings that take key lights apart are lit by the probe's, where it has some.
    void set_probe(const lighting::LightProbe& probe);
    void set_camera(const scene::Camera& camera) { camera_ = camera; }

    std::shared_ptr<const diffraction::GpuMaterial> upload(const diffraction::CookedMaterial& material) const;
    /// Shades the disc by the engine's own material, by a grating, or light by light.
    void show_plain();
    void show_grating(std::shared_ptr<const diffraction::GpuMaterial> material);
    void show_light_loop(std::shared_ptr<const LightLoop> loop);
    const glm::dmat3& xyz_to_working() const { return xyz_to_working_; }

    /// Draws a frame and waits for it. Milliseconds. `effects`: with bloom, automatic exposure, vignette, display
    /// transform and dither.
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

}  // namespace rowland::trade
