#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/ecs/world.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/lighting/sh_light.h"

namespace rowland::render {

/// Component: the engine's metallic-roughness surface.
struct StandardMaterial {
    glm::vec3 base_colour{0.8F};  ///< linear Rec.709
    float metallic = 0.0F;
    float roughness = 0.5F;  ///< perceptual
};

/// All distant light of a frame: the probe and the scene's directional lights, as raw radiance SH in world axes.
/// `version` changes whenever the light does.
struct FrameLight {
    lighting::ShLight sh;
    std::uint64_t version = 0;
};

/// A kind of surface that a module adds to the engine. Its shaders include the engine's forward interface and define
/// the material_vertex and material_terms functions (see engine/render/shaders/forward_*_interface.glsl). Texture units
/// and buffer bindings from 4 on are its own.
class MaterialType {
 public:
    virtual ~MaterialType() = default;
    MaterialType() = default;
    MaterialType(const MaterialType&) = delete;
    MaterialType& operator=(const MaterialType&) = delete;

    /// Makes its shader files known. Called once, when it is registered.
    virtual void add_shaders(gpu::ShaderLibrary& library) const = 0;
    /// Whether it draws this entity.
    virtual bool owns(ecs::World& world, ecs::Entity entity) const = 0;
    /// The program an owned entity is drawn with; equal descriptions share one.
    virtual gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity) const = 0;
    /// Once a frame, before anything is drawn: brings per-object data up to date.
    virtual void update(ecs::World& world, const FrameLight& light) = 0;
    /// Binds what an owned entity's program reads. The program is in use.
    virtual void bind(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const = 0;
};

}  // namespace rowland::render
