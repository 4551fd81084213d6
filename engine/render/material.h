#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/ecs/world.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/environment_map.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_texels.h"
#include "engine/lighting/sh_light.h"
#include "engine/scene/material_description.h"

namespace rowland::render {

/// A texture on a surface.
struct SurfaceTexture {
    std::shared_ptr<const gpu::Texture> texture;  ///< none: the factor alone
    int uv_set = 0;
    scene::TextureTransform transform;

    explicit operator bool() const { return texture != nullptr; }
};

/// Component: the engine's metallic-roughness surface.
struct StandardMaterial {
    glm::vec3 base_colour{0.8F};  ///< linear Rec.709
    float metallic = 0.0F;
    float roughness = 0.5F;    ///< perceptual
    float alpha = 1.0F;        ///< of Mask and Blend
    glm::vec3 emissive{0.0F};  ///< radiance, linear Rec.709
    SurfaceTexture base_colour_texture = {};
    SurfaceTexture metallic_roughness_texture = {};  ///< G: roughness, B: metallic
    SurfaceTexture normal_texture = {};
    float normal_scale = 1.0F;
    SurfaceTexture occlusion_texture = {};  ///< R, of ambient light only
    float occlusion_strength = 1.0F;
    SurfaceTexture emissive_texture = {};
    scene::AlphaMode alpha_mode = scene::AlphaMode::Opaque;
    float alpha_cutoff = 0.5F;
    bool double_sided = false;
    bool unlit = false;  ///< shows base colour and emission, whatever the light
};

/// A distant light of a frame without extent: a DirectionalLight in world axes.
struct DistantLight {
    glm::vec3 direction{0.0F, 1.0F, 0.0F};  ///< unit, toward the light
    glm::vec3 irradiance{0.0F};             ///< on a surface that faces it, linear Rec.709

    friend bool operator==(const DistantLight&, const DistantLight&) = default;
};

/// All distant light of a frame, linear Rec.709, world axes: whole as `sh`, or split into `residual`, `key_lights` and
/// `distant_lights`, which sum to the same. `version` changes whenever any of it does.
struct FrameLight {
    lighting::ShLight sh;                        ///< raw radiance: the probe and the distant lights
    lighting::ShLight probe_sh;                  ///< the probe alone
    lighting::ShLight residual;                  ///< the probe less its key lights
    std::vector<lighting::KeyLight> key_lights;  ///< of the probe; none if the renderer does without them
    std::vector<DistantLight> distant_lights;    ///< of the scene
    /// Colours of the scene's lights of any kind, those of lights[] in the shaders: linear Rec.709, the largest
    /// component 1, each once. Not part of `version`.
    std::vector<glm::vec3> light_colours;
    std::shared_ptr<const lighting::LightTexels> probe_texels;  ///< the probe alone, at full resolution
    std::shared_ptr<const lighting::LightTexels> texels;        ///< the probe less its key lights, likewise
    /// The whole probe, key lights and all, as a cube map of one level: its mean over each texel. Null: none.
    std::shared_ptr<const lighting::PackedEnvironmentMap> radiance;
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of its white
    std::uint64_t version = 0;
};

class SurfaceTextures;

/// A kind of surface that a module adds to the engine. Its shaders include the engine's forward interface and define
/// the material_vertex and material_terms functions (see engine/render/shaders/forward_*_interface.glsl). Texture units
/// 8 to 14 and buffer bindings from 4 on are its own.
class MaterialType {
 public:
    virtual ~MaterialType() = default;
    MaterialType() = default;
    MaterialType(const MaterialType&) = delete;
    MaterialType& operator=(const MaterialType&) = delete;

    /// The glTF material extension that describes such a surface; empty if none does.
    virtual std::string gltf_extension() const { return {}; }
    /// Gives an entity, which has its MeshInstance and StandardMaterial already, the surface that the extension's JSON
    /// describes; `textures`: those of its file. `file` and `place` (a JSON pointer) are for messages. Throws Error
    /// (input).
    virtual void attach(ecs::World& world, ecs::Entity entity, const nlohmann::json& extension,
                        SurfaceTextures& textures, const std::string& file, const std::string& place);

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
