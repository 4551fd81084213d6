#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/gpu/draw_meter.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/light_probe.h"
#include "engine/scene/imported_scene.h"

namespace rowland::render {

struct SurfaceTexture {
    std::shared_ptr<const gpu::Texture> texture;  ///< null: the factor alone
    int uv_set = 0;
    scene::TextureTransform transform;

    explicit operator bool() const { return texture != nullptr; }
    friend bool operator==(const SurfaceTexture& a, const SurfaceTexture& b) {
        const auto members = [](const SurfaceTexture& of) {
            const auto& [offset, rotation, scale] = of.transform;
            return std::tie(of.texture, of.uv_set, offset, rotation, scale);
        };
        return members(a) == members(b);
    }
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
    bool passes_light = false;  ///< the material type's background_weight() replaces alpha
    float alpha_cutoff = 0.5F;
    bool double_sided = false;
    bool unlit = false;       ///< shows base colour and emission, independent of light
    float clear_coat = 0.0F;  ///< strength of a dielectric layer on top, 0 to 1; not of a material type's surface
    float clear_coat_roughness = 0.0F;  ///< perceptual
    SurfaceTexture wear_texture = {};   ///< scene::wear_map()
    bool scratched = true;              ///< whether wear_texture has scratches

    friend bool operator==(const StandardMaterial&, const StandardMaterial&) = default;
};

/// A DirectionalLight of the scene in world axes.
struct DistantLight {
    glm::vec3 direction{0.0F, 1.0F, 0.0F};  ///< unit, toward the light
    glm::vec3 irradiance{0.0F};             ///< on a surface that faces it, linear Rec.709

    friend bool operator==(const DistantLight&, const DistantLight&) = default;
};

/// A frame's light under one probe, as material types get it. Linear Rec.709, world axes.
struct FrameLight {
    std::shared_ptr<const lighting::LightProbe> probe;
    /// Whether the renderer shades the probe's key lights as analytic lights (KEY_LIGHTS in shaders). If so, all
    /// other diffuse light excludes them.
    bool analytic_key_lights = false;
    std::vector<DistantLight> distant_lights = {};  ///< all directional lights of the scene
    std::uint64_t version = 0;                      ///< changes with any member above
    /// Irradiance or intensity of each of lights[] in the shaders (scene_blocks.h). Not part of `version`.
    std::vector<glm::vec3> light_strengths = {};

    /// The probe's key lights that are shaded as analytic lights; empty unless `analytic_key_lights`.
    std::span<const lighting::KeyLight> key_lights() const {
        return analytic_key_lights && probe ? std::span(probe->key_lights) : std::span<const lighting::KeyLight>();
    }
};

/// The one or two probes of an object, as indexes of a frame's FrameLights: 0 is the renderer's own, i + 1 that of its
/// volume i (probe_volumes.h). `first` is less than `second`; in a fade by DrawControl::second_part() both are equal.
struct LightMix {
    std::size_t first = 0;
    std::size_t second = 0;
    float second_part = 0.0F;  ///< fraction of the light that `second` gives; 0: there is no second

    bool has_second() const { return second_part > 0.0F; }
    bool is_local() const { return first > 0 || has_second(); }
    friend bool operator==(const LightMix&, const LightMix&) = default;
};

/// An entity that is drawn, and its light.
struct LitEntity {
    ecs::Entity entity;
    LightMix light;
};

/// Which of its probes an entity is drawn under. An entity between two is drawn under each, and the radiances are
/// added.
enum class ProbeSlot { First, Second };

/// How a material type keeps the time that its entities' draws take within a limit.
class DrawControl {
 public:
    virtual ~DrawControl() = default;
    DrawControl() = default;
    DrawControl(const DrawControl&) = delete;
    DrawControl& operator=(const DrawControl&) = delete;

    /// Gets the measured times of an earlier frame's draws. Called before MaterialType::update(), in frames in which
    /// measurements have arrived. MeteredRun::Draw::object is an entity's object_number().
    virtual void take(ecs::World& world, std::span<const gpu::MeteredRun> runs) = 0;
    /// A number for the draw, not 0: draws of one kind should take the same time per sample.
    virtual std::uint64_t kind(ecs::World& world, ecs::Entity entity, ProbeSlot slot) const = 0;
    /// A fade from one picture of the entity to another: an entity that has one probe is drawn twice under it, in both
    /// slots, the second time with this fraction of the light, more than 0. nullopt: it is drawn once. Called after
    /// MaterialType::update().
    virtual std::optional<float> second_part(ecs::World& world, ecs::Entity entity) const = 0;
};

/// The number of an entity in gpu::MeteredRun; entity_of() is the inverse.
std::uint64_t object_number(ecs::Entity entity);
ecs::Entity entity_of(std::uint64_t object_number);

/// A program that will draw an entity.
struct LaterProgram {
    gpu::ProgramDesc desc;
    bool draws_instances = false;  ///< whether the entity will have a MaterialType::binding_key()
};

class SurfaceTextures;

/// A material extension of a scene, as MaterialType::attach() gets it.
struct MaterialExtension {
    const nlohmann::json& object;
    const scene::MaterialDescription& material;  ///< whose extension it is
    const std::string& file;                     ///< for messages
    std::string pointer;                         ///< JSON pointer of the object, for messages

    /// What the module's cook::GltfExtension::cook baked. Throws Error (input) if the scene has not been cooked.
    const std::vector<std::byte>& tables(const std::string& extension) const;
};

/// A kind of surface that a module adds to the engine: see engine/MODULES.md. Its shaders include the engine's
/// surface.glsl, environment.glsl and shading.glsl (fragment stage) or vertex.glsl (vertex stage). Texture units 8 to
/// 14 and buffer bindings from 4 on are its own.
class MaterialType {
 public:
    virtual ~MaterialType() = default;
    MaterialType() = default;
    MaterialType(const MaterialType&) = delete;
    MaterialType& operator=(const MaterialType&) = delete;

    /// For messages: "metal".
    virtual std::string name() const = 0;
    /// The glTF material extension that describes such a surface; empty if none does.
    virtual std::string gltf_extension() const { return {}; }
    /// Other extensions of the material that the surface depends on. instantiate() warns that they are ignored in a
    /// material without gltf_extension().
    virtual std::vector<std::string> gltf_extensions_beside() const { return {}; }
    /// Gives an entity, which already has its MeshInstance and StandardMaterial, the surface that the extension and its
    /// tables describe. `textures`: those of its file. Throws Error (input) if the extension is wrong or not cooked. A
    /// type with a gltf_extension() must override it.
    virtual void attach(ecs::World& world, ecs::Entity entity, const MaterialExtension& extension,
                        SurfaceTextures& textures);

    /// Adds its shader files. Called once, when it is registered.
    virtual void add_shaders(gpu::ShaderLibrary& library) const = 0;
    /// Whether it draws this entity. At most one type may.
    virtual bool owns(ecs::World& world, ecs::Entity entity) const = 0;
    /// The program that draws an owned entity; equal descriptions share one.
    virtual gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity, ProbeSlot slot) const = 0;
    /// Draws of equal keys have equal program(), which is then not called again, and are drawn one after the other;
    /// 0: call program() for each draw.
    virtual std::uint64_t program_key(ecs::World& /*world*/, ecs::Entity /*entity*/, ProbeSlot /*slot*/) const {
        return 0;
    }
    /// Entities of equal keys, programs, meshes and StandardMaterials are drawn at once, after bind() for one of them:
    /// the key must tell what else bind() reads. 0: each is bound and drawn by itself.
    virtual std::uint64_t binding_key(ecs::World& /*world*/, ecs::Entity /*entity*/, ProbeSlot /*slot*/) const {
        return 0;
    }
    /// A second program, with which an owned entity that passes light is drawn again, over itself; nullopt: none.
    virtual std::optional<gpu::ProgramDesc> overlay_program(ecs::World& world, ecs::Entity entity,
                                                            ProbeSlot slot) const;
    /// Programs that will draw an owned entity in place of program() and overlay_program(), without a change of the
    /// scene: they are compiled in this frame as well.
    virtual std::vector<LaterProgram> later_programs(ecs::World& world, ecs::Entity entity, ProbeSlot slot) const;
    /// Updates per-object data. Called once per frame of Shading::Full, before programs are asked for and anything is
    /// drawn. `lights`: by index of LightMix. `seen`: the drawn entities, of any type, that are in the picture, then
    /// others that mirrors may show.
    virtual void update(ecs::World& world, std::span<const FrameLight> lights, std::span<const LitEntity> seen) = 0;
    /// A number that changes in each update() after which an entity looks different although neither it nor the light
    /// has changed.
    virtual std::uint64_t version() const { return 0; }
    /// Null: its draws are not timed.
    virtual DrawControl* draw_control() const { return nullptr; }
    /// Binds what an owned entity's program reads. The program is in use.
    virtual void bind(ecs::World& world, ecs::Entity entity, ProbeSlot slot, const gpu::Program& program) const = 0;
    /// The same for overlay_program().
    virtual void bind_overlay(ecs::World& world, ecs::Entity entity, ProbeSlot slot, const gpu::Program& program) const;
};

/// The type that draws an entity; null: the engine's own surface. `file` and `json_pointer` (empty: the
/// entity's name) are for messages. Throws Error (input), which names both types, if two own it.
const MaterialType* owner_of(ecs::World& world, ecs::Entity entity,
                             std::span<const std::unique_ptr<MaterialType>> types, const std::string& file,
                             const std::string& json_pointer = {});

}  // namespace rowland::render
