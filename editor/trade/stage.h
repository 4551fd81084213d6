#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
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

/// Disc and sphere on the GPU (picture_scene.h), under a probe and one directional light. Needs a current context.
class Stage {
 public:
    Stage(glm::ivec2 size, const scene::Camera& camera);

    /// Its key lights are lights of their own for gratings that take them apart, if there are any.
    void set_probe(const lighting::LightProbe& probe);
    void set_directional_light(bool on);
    void set_camera(const scene::Camera& camera) { camera_ = camera; }
    void show_sphere(bool show);

    std::shared_ptr<const diffraction::GpuMaterial> upload(const diffraction::CookedMaterial& material) const;
    /// What the surfaces are from now on: the engine's own material, a grating, or one that is shaded light by light.
    void show_plain();
    void show_grating(std::shared_ptr<const diffraction::GpuMaterial> material);
    void show_light_loop(std::shared_ptr<const LightLoop> loop);
    const glm::dmat3& xyz_to_working() const { return xyz_to_working_; }

    /// Draws a frame and waits for it. Milliseconds.
    double draw();
    /// The same with all effects: bloom, automatic exposure, vignette, display transform, dither.
    double draw_with_effects();
    /// A frame as the display shows it, with the display transform alone: RGB, rows from the top.
    std::vector<std::uint8_t> picture(float exposure_stops);

    std::size_t vertices() const { return vertices_; }

 private:
    void render();
    ecs::Entity add_surface(scene::Mesh mesh, const glm::vec3& place);
    void clear_materials();

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
    std::optional<ecs::Entity> sphere_;
    std::optional<ecs::Entity> light_;
    bool key_lights_ = false;  ///< the probe has some
    std::size_t vertices_ = 0;
    std::uint32_t frame_ = 0;
};

}  // namespace rowland::trade
