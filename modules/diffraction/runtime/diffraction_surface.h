#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/math/spherical_harmonics.h"
#include "engine/render/material.h"
#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/map_cache.h"
#include "modules/diffraction/runtime/rung_control.h"
#include "modules/diffraction/runtime/surface_light.h"

namespace rowland::diffraction {

/// Component: a surface with a grating.
struct DiffractionSurface {
    std::shared_ptr<const GpuMaterial> material = nullptr;
    float groove_rotation = 0.0F;  ///< radians by which g is turned from the mesh's tangent toward its bitangent
    std::shared_ptr<const GrooveMap> grooves = nullptr;  ///< varies direction and pitch over the surface
};

/// Gives an entity, which already has its StandardMaterial, a grating. `has_base`: the material's base replaces it.
void add_surface(ecs::World& world, ecs::Entity entity, DiffractionSurface surface, bool has_base);

struct DiffractionSettings {
    /// On band-limited light, against ringing; nullopt: the weakest sufficient window.
    std::optional<math::SphericalWindow> window = std::nullopt;
    MapPace map_pace = MapPace::Incremental;
    std::chrono::milliseconds map_wait = kMapWait;  ///< the longest that a frame waits for coarse maps
};

/// Whether maps are still being filled for the light and the objects that were last seen.
bool maps_are_filling(ecs::World& world);

/// Draws entities that have a DiffractionSurface, each by its material's representation or, where an entity has a
/// FrameBudget, by the rung that the budget allows. The data of an object that is seen is updated when the light, the
/// object or its material changes.
class DiffractionSurfaceType final : public render::MaterialType {
 public:
    /// `xyz_to_working` as the renderer's.
    explicit DiffractionSurfaceType(const glm::dmat3& xyz_to_working, const DiffractionSettings& settings = {});

    std::string name() const override { return "diffraction"; }
    std::string gltf_extension() const override;
    /// Equal gratings use the same tables.
    void attach(ecs::World& world, ecs::Entity entity, const render::MaterialExtension& extension,
                render::SurfaceTextures& textures) override;

    void add_shaders(gpu::ShaderLibrary& library) const override;
    bool owns(ecs::World& world, ecs::Entity entity) const override;
    gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) const override;
    std::uint64_t program_key(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) const override;
    std::uint64_t binding_key(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) const override;
    std::vector<render::LaterProgram> later_programs(ecs::World& world, ecs::Entity entity,
                                                     render::ProbeSlot slot) const override;
    void update(ecs::World& world, std::span<const render::FrameLight> lights,
                std::span<const render::LitEntity> seen) override;
    std::uint64_t version() const override { return version_; }
    render::DrawControl* draw_control() const override { return control_.get(); }
    void bind(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot,
              const gpu::Program& program) const override;
    std::optional<gpu::ProgramDesc> overlay_program(ecs::World& world, ecs::Entity entity,
                                                    render::ProbeSlot slot) const override;
    void bind_overlay(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot,
                      const gpu::Program& program) const override;

 private:
    void follow_budget(ecs::World& world, std::span<const render::LitEntity> seen);
    void update_seen(ecs::World& world, const render::LitEntity& lit);
    /// Updates an entity's data under one of its probes.
    void update_lit(ecs::World& world, ecs::Entity entity, SurfaceLight& light, SurfaceState& state, bool may_wait);
    /// The light of the probe that `state` is for.
    const SurfaceLight& light_of(const SurfaceState& state) const { return *lights_[state.probe]; }
    void warn_illuminant_mismatch(const std::string& baked_for, const std::string& lit_by);
    /// One map for all surfaces with the same image and equal "grooveTexture" objects.
    std::shared_ptr<const GrooveMap> groove_map(const GrooveTexture& use, const render::MaterialExtension& extension,
                                                render::SurfaceTextures& textures);
    std::shared_ptr<const GpuMaterial> uploaded(const std::vector<std::byte>& tables, const std::string& file);

    glm::dmat3 xyz_to_working_;
    std::map<std::string, std::weak_ptr<const GpuMaterial>> uploaded_;  ///< by the hash of the tables
    std::map<std::pair<const image::ByteImage*, std::string>, std::weak_ptr<const GrooveMap>> groove_maps_;
    std::set<std::pair<std::string, std::string>> warned_pairs_;  ///< illuminants baked for, lit by
    std::optional<math::SphericalWindow> window_;
    std::vector<std::unique_ptr<SurfaceLight>> lights_;  ///< by index of the frame's lights
    MapCache maps_;
    std::unique_ptr<RungControl> control_;  ///< while there is a FrameBudget
    std::uint64_t version_ = 0;
};

}  // namespace rowland::diffraction
