#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/context.h"
#include "engine/gpu/draw_meter.h"
#include "engine/gpu/framebuffer.h"
#include "engine/gpu/pass_times.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/light_probe.h"
#include "engine/render/draw_list.h"
#include "engine/render/effects.h"
#include "engine/render/light_maps.h"
#include "engine/render/material.h"
#include "engine/render/probe_volumes.h"
#include "engine/render/reflections.h"
#include "engine/render/scene_lights.h"
#include "engine/render/shaders/scene_blocks.h"
#include "engine/render/surface_programs.h"
#include "engine/scene/camera.h"

namespace rowland::render {

/// How the opaque pass shades. The sky is drawn in both.
enum class Shading {
    Full,
    Unlit,  ///< every surface shows base colour and emission, to measure a frame without shading
};

/// Counts of the last frame.
struct FrameReport {
    int drawn = 0;                      ///< entities in the picture
    int culled = 0;                     ///< entities outside it
    int shadow_drawn = 0;               ///< entities in the shadow map
    int reflections_drawn = 0;          ///< draws into mirrors' surroundings; 0 unless these changed
    int programs = 0;                   ///< compiled so far
    std::vector<gpu::PassTime> passes;  ///< latest measured times, if set_pass_times() was called
};

/// Forward HDR renderer: draws all entities with a MeshInstance, a StandardMaterial and a WorldMatrix, then the sky,
/// then those that blend, into a float framebuffer with depth, in the working space. Light comes from the probe or, by
/// the centre of an entity's bounds, from up to two probes of entities with a ProbeVolume, and from entities with a
/// DirectionalLight or a PunctualLight, at most 64; only the first directional light with `casts_shadow` casts a
/// shadow. An entity with PictureColumns is drawn in these columns only, and casts its whole shadow.
class Renderer {
 public:
    /// `xyz_to_working`: from XYZ to the linear space in which images are rendered (normally ACEScg).
    explicit Renderer(const glm::dmat3& xyz_to_working);

    void add_material_type(std::unique_ptr<MaterialType> type);
    std::span<const std::unique_ptr<MaterialType>> material_types() const { return types_; }
    /// The glTF material extensions of the registered types.
    std::vector<std::string> gltf_extensions() const;

    /// Lights the scene with this probe where no ProbeVolume does. It is the sky.
    void set_probe(lighting::LightProbe probe);
    /// Whether the probe's key lights are shaded as analytic lights (FrameLight::analytic_key_lights). Off by default:
    /// diffuse light is the probe's first nine SH terms.
    void use_key_lights(bool use);
    /// Texels along a side of the shadow map, at least 32; 2048 by default.
    void set_shadow_map_size(int size);
    /// The effects of the next frames; none by default.
    void set_effects(const Effects& effects);
    const Effects& effects() const { return effects_; }
    /// Where the times of the passes "shadow", "reflections", "occlusion", "opaque", "sky" and "blend" are written;
    /// null, the default: nowhere. The owner calls begin_frame(). Must outlive the draws.
    void set_pass_times(gpu::PassTimes* times) { times_ = times; }
    /// Rebuilds all programs in use, from `source_tree` where it has their files. If one does not compile, all stay as
    /// they were and its Error (system) with file and line is thrown.
    void reload_shaders(const std::filesystem::path& source_tree);

    /// Draws a frame. A probe must have been set. Data that only visible entities need are computed when they become
    /// visible; the programs of a surface are compiled in the first frame that it is in, visible or not. After setting
    /// OpenGL's state by other means than rowland::gpu, call gpu::forget_bound_state() first. Throws Error (input) if
    /// two material types own one entity, Error (system) if a program does not compile.
    void render(ecs::World& world, const scene::Camera& camera, const gpu::Framebuffer& target,
                Shading shading = Shading::Full);
    const FrameReport& report() const { return report_; }

    const glm::dmat3& xyz_to_working() const { return xyz_to_working_; }
    const gpu::ShaderLibrary& shaders() const { return programs_.library(); }

 private:
    /// The state of one call of render().
    struct Frame {
        const scene::Camera* camera = nullptr;
        glm::ivec2 size{1};
        float aspect = 1.0F;
        bool into_halves = false;  ///< the target holds half floats
        Shading shading = Shading::Full;
        bool occlusion = false;
        glm::mat4 view_projection{1.0F};
        DrawList list;
        std::vector<const Draw*> opaque;
        std::vector<const Draw*> blended;
        std::vector<const Draw*> casters;
        std::vector<Batch> opaque_batches;
        std::vector<Batch> blended_batches;
        std::vector<Batch> caster_batches;
        ShadowView shadow;
        std::vector<bool> lit;                   ///< by probe: whether it lights a draw
        std::vector<std::size_t> frame_offsets;  ///< by probe: of its FrameBlock in frame_data_, bytes
        std::size_t light_offset = 0;            ///< of the LightBlock in frame_data_, bytes
        std::size_t joints_offset = 0;           ///< of the joint matrices
        float farthest = 0.0F;                   ///< largest depth of the drawn entities' bounds, metres
    };

    SurfaceFeatures light_features(const Frame& frame) const;
    void update_light(ecs::World& world);
    void update_volumes(ecs::World& world);
    void update_ambient(LitProbe& probe) const;
    void choose_probes(Frame& frame);
    void update_materials(ecs::World& world, Frame& frame);
    void select_draws(ecs::World& world, Frame& frame);
    void select_casters(Frame& frame);
    FrameBlock frame_block(const Frame& frame, std::size_t probe) const;
    void upload(Frame& frame);
    void stage(std::vector<Batch>& batches);
    void bind_frame(const Frame& frame) const;
    void bind_probe(const Frame& frame, std::size_t probe) const;
    void draw_shadow_map(Frame& frame);
    void draw_occlusion(const Frame& frame);
    void update_reflection(ecs::World& world, const Frame& frame);
    void draw_object_reflections(ecs::World& world, Frame& frame);
    Frame surroundings(ecs::World& world, const Frame& frame, ecs::Entity group);
    void update_staleness(const Frame& around, ObjectReflection& reflection) const;
    void draw_surroundings(ecs::World& world, Frame& around, ObjectReflection& reflection);
    void draw_outline(const Batch& batch, const gpu::Program& program) const;
    void draw_mesh(const Batch& batch) const;
    /// `meter`: of the draws of types that have a DrawControl; null: they are not measured.
    void draw_pass(ecs::World& world, const Frame& frame, const std::vector<Batch>& batches,
                   gpu::DrawMeter* meter = nullptr);
    void draw_lit(ecs::World& world, const Frame& frame, const Batch& batch, ProbeSlot slot,
                  gpu::DrawMeter* meter) const;
    void take_metered(ecs::World& world);
    void draw_sky(const Frame& frame);
    void bind_surface(const Draw& draw) const;
    const gpu::Program& program_of(ecs::World& world, const Draw& draw, ProbeSlot slot);
    const gpu::Program* overlay_program_of(ecs::World& world, const Draw& draw, ProbeSlot slot);
    void compile_later_programs(ecs::World& world, const Draw& draw, ProbeSlot slot);
    const gpu::Program& surface_program(const char* shader, SurfaceFeatures features);

    glm::dmat3 xyz_to_working_;
    glm::dmat3 rec709_to_working_;
    gpu::Limits limits_ = gpu::read_limits();
    std::vector<std::unique_ptr<MaterialType>> types_;
    ProgramCache programs_;
    std::map<std::pair<std::string, SurfaceFeatures>, const gpu::Program*> surface_programs_;  ///< of programs_
    /// Of programs_, by MaterialType::program_key().
    std::map<std::tuple<const MaterialType*, std::uint64_t, SurfaceFeatures>, const gpu::Program*> type_programs_;
    gpu::VertexArray no_vertices_;
    std::vector<std::byte> staging_;  ///< of frame_data_
    gpu::StreamBuffer frame_data_;    ///< FrameBlock, LightBlock, ObjectBlocks, Placements and joint matrices
    gpu::Texture brdf_table_;
    gpu::Texture lobe_nodes_;
    std::optional<gpu::Framebuffer> shadow_map_;
    int shadow_map_size_ = 2048;
    Effects effects_;
    std::optional<AmbientOcclusion> occlusion_;
    std::optional<LocalReflection> reflection_;
    std::optional<ObjectReflections> object_reflections_;

    std::optional<LitProbe> probe_;
    std::map<const lighting::LightProbe*, LitProbe> local_probes_;
    ProbeVolumes volumes_;                 ///< of the frame
    std::vector<LitProbe*> frame_probes_;  ///< by index of the frame's lights: probe_, then those of volumes_
    std::vector<FrameLight> frame_lights_;
    bool analytic_key_lights_ = false;
    std::uint64_t light_version_ = 0;
    SceneLights lights_;
    bool warned_dropped_lights_ = false;
    gpu::PassTimes* times_ = nullptr;
    std::optional<gpu::DrawMeter> meter_;  ///< set while a type has a DrawControl
    FrameReport report_;
};

}  // namespace rowland::render
