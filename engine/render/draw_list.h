#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/gpu/pipeline_state.h"
#include "engine/gpu/program.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/material.h"
#include "engine/render/reflections.h"
#include "engine/render/shaders/scene_blocks.h"
#include "engine/render/surface_programs.h"
#include "engine/scene/mesh.h"

namespace rowland::render {

/// Component: limits the entity to these columns of the picture, given as fractions of its width from the left. Two
/// entities at one position that split the picture cost as many pixels as one.
struct PictureColumns {
    float begin = 0.0F;
    float end = 1.0F;
};

/// An entity to be drawn in this frame. The pointers are valid until a component storage changes.
struct Draw {
    ecs::Entity entity;
    const GpuMesh* mesh = nullptr;
    const StandardMaterial* material = nullptr;
    const MaterialType* type = nullptr;  ///< null: the engine's own surface
    glm::mat4 matrix{1.0F};
    scene::Bounds bounds;  ///< in the world
    bool mirrored = false;
    bool skinned = false;
    std::size_t first_joint = 0;
    SurfaceFeatures features = 0;
    bool in_picture = false;  ///< whether its bounds are in the camera's view volume
    LightMix light = {};
    /// How it is drawn under one of its probes.
    struct Lit {
        const gpu::Program* program = nullptr;          ///< null if it is not drawn in the main pass
        const gpu::Program* overlay_program = nullptr;  ///< MaterialType::overlay_program(), or null
        std::uint64_t key = 0;                          ///< MaterialType::program_key()
        std::uint64_t binding = 0;                      ///< MaterialType::binding_key()
        std::uint64_t kind = 0;                         ///< DrawControl::kind(); 0: its time is not measured
    };
    Lit first = {};
    Lit second = {};
    const gpu::Program* depth_program = nullptr;   ///< null if it is not drawn into the depth of occlusion
    const gpu::Program* shadow_program = nullptr;  ///< null if no light casts its shadow
    float distance2 = 0.0F;                        ///< from the eye to the bounds' centre, squared
    const PictureColumns* columns = nullptr;       ///< null: all
    std::optional<ecs::Entity> reflects = {};      ///< the group of its ReflectsObjects
    const ObjectReflection* reflection = nullptr;  ///< of that group
    /// Number of its mesh, type and material, if at least kLeastInstances draws have them; 0: they may not be
    /// instances.
    std::size_t repeated = 0;

    bool is_instance() const { return (features & feature::kInstanced) != 0; }
};

/// From so many draws of a mesh and a material on, a program of their own is worth it.
inline constexpr int kLeastInstances = 8;

/// Draws that differ in nothing but their transform, as one draw of instances, or any other draw.
struct Batch {
    std::span<const Draw* const> draws;  ///< one, or instances
    /// Offsets in the renderer's buffer, bytes: of the ObjectBlock for each of the probes, and of instances'
    /// Placements.
    std::size_t first_block = 0;
    std::size_t second_block = 0;
    std::size_t placements = 0;

    const Draw& front() const { return *draws.front(); }
};

struct DrawList {
    std::vector<Draw> draws;
    std::vector<glm::mat4> joints;  ///< of all skinned draws, one after the other
};

/// All entities that have a MeshInstance, a StandardMaterial and a WorldMatrix. `lights`: the bits of feature::kLights
/// that the frame has. Throws Error (input) if two material types own one entity.
DrawList gather_draws(ecs::World& world, std::span<const std::unique_ptr<MaterialType>> types, SurfaceFeatures lights);

/// A texture transform as the columns of a 2×2 matrix and an offset, as shaders take it.
struct UvTransform {
    glm::vec4 linear{1.0F, 0.0F, 0.0F, 1.0F};
    glm::vec2 offset{0.0F};
};
/// KHR_texture_transform: offset · rotation · scale, the rotation counter-clockwise where v points down.
UvTransform uv_transform(const scene::TextureTransform& transform);

/// What shaders read of a draw that gives the fraction `part` of the surface's light.
ObjectBlock object_block(const Draw& draw, const glm::mat3& rec709_to_working, float part);

/// Sorts by program, kind, probe, material and, of instances, what they show and their mesh, for few changes of state,
/// then from front to back, for little overdraw.
void sort_opaque(std::vector<const Draw*>& draws);

/// The draws in their order; neighbours that are lit alike become instances. `draws` must outlive the result.
std::vector<Batch> lit_batches(std::span<const Draw* const> draws);
/// The same for shadow_program, which reads less of a draw. Sorts the draws.
std::vector<Batch> shadow_batches(std::vector<const Draw*>& draws);

Placement placement(const Draw& draw);

/// The fixed-function state that draws a surface into a target of this size; nullopt if its columns
/// are narrower than a pixel.
std::optional<gpu::PipelineState> state_of(const Draw& draw, glm::ivec2 size);
/// The state that adds the surface under its second probe to the picture.
gpu::PipelineState adding(const gpu::PipelineState& first);

}  // namespace rowland::render
