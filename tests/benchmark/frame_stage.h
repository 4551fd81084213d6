#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/pass_times.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/renderer.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/groove_map.h"
#include "tests/benchmark/frame_variant.h"

namespace rowland::benchmark {

/// The renderers, meshes and materials of all variants; those that several variants use are created once.
class FrameStage {
 public:
    FrameStage(glm::ivec2 size, diffraction::MapPace map_pace);

    const render::MeshInstance& disc() const { return disc_; }
    /// One renderer per light and effect: a change would update everything that depends on it.
    render::Renderer& renderer(const FrameVariant& variant);
    /// A variant's material on the GPU; its light fills the maps.
    std::shared_ptr<const diffraction::GpuMaterial> material(const FrameVariant& variant);
    std::shared_ptr<const diffraction::GrooveMap> groove_map();

    void draw(const FrameVariant& variant, ecs::World& world, render::Shading shading);
    const gpu::Framebuffer& picture() const { return picture_; }
    const glm::dmat3& xyz_to_working() const { return xyz_to_working_; }

 private:
    std::unique_ptr<render::Renderer> make_renderer(const FrameVariant& variant) const;
    const diffraction::CookedMaterial& cooked(const nlohmann::json& material);

    glm::dmat3 xyz_to_working_;
    diffraction::MapPace map_pace_;
    gpu::Framebuffer picture_;
    render::MeshInstance disc_;
    std::map<std::tuple<Lighting, int, Effect>, std::unique_ptr<render::Renderer>> renderers_;
    std::map<std::string, diffraction::CookedMaterial> cooked_;
    std::map<std::pair<std::string, const render::Renderer*>, std::shared_ptr<const diffraction::GpuMaterial>>
        materials_;
    std::shared_ptr<const diffraction::GrooveMap> groove_map_;
};

/// The times of a frame.
struct FrameTime {
    double wall_ms = 0.0;  ///< until the picture is done
    /// The GPU's own time, or where the processor draws that of all its threads; other programs hardly disturb it.
    double work_ms = 0.0;
};

/// A variant's own world.
class FrameScene {
 public:
    /// `software`: whether the processor draws.
    FrameScene(FrameVariant variant, FrameStage& stage, bool software);

    /// Draws the next frame.
    FrameTime draw();
    /// Whether the disc was drawn without its map, which is being filled.
    bool awaits_map();
    /// Draws until no shader is compiled and no map is filled.
    void settle();
    const FrameVariant& variant() const { return variant_; }

 private:
    void add_box();
    void add_instances();
    void add_film();
    void add_wear();
    void add_reflected_plane();
    void shade_in_a_loop(const std::vector<render::DistantLight>& lights);
    void shade_by_peer(const std::vector<render::DistantLight>& lights);

    FrameVariant variant_;
    FrameStage* stage_;
    bool software_;
    ecs::World world_;
    ecs::Entity disc_;
    gpu::PassTimes times_;
};

}  // namespace rowland::benchmark
