#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"
#include "engine/gpu/vertex_array.h"
#include "engine/lighting/light_probe.h"
#include "engine/render/environment.h"
#include "engine/render/material.h"
#include "engine/scene/camera.h"

namespace rowland::render {

/// How the opaque pass shades; the sky is drawn in either.
enum class Shading {
    Full,
    Unlit,  ///< every surface its base colour: what a frame costs without any shading
};

/// Forward HDR renderer: draws all entities with a MeshInstance, a StandardMaterial and a WorldMatrix, then the sky,
/// into a float framebuffer with depth, in the working space.
class Renderer {
 public:
    /// `xyz_to_working`: from XYZ to the linear space images are made in (normally ACEScg).
    explicit Renderer(const glm::dmat3& xyz_to_working);

    void add_material_type(std::unique_ptr<MaterialType> type);
    /// From now on the scene stands in this light.
    void set_probe(const lighting::LightProbe& probe);
    /// Compiles all programs in use anew, from `source_tree` where it has their files. If one does not compile, all
    /// stay as they were and its Error (system) with file and line is thrown.
    void reload_shaders(const std::filesystem::path& source_tree);
    /// Draws a frame. A probe must have been set.
    void render(ecs::World& world, const scene::Camera& camera, const gpu::Framebuffer& target,
                Shading shading = Shading::Full);

 private:
    void update_light(ecs::World& world);
    void upload_frame(const scene::Camera& camera, float aspect);
    void draw_entities(ecs::World& world, Shading shading);
    void draw_sky();
    const MaterialType* type_of(ecs::World& world, ecs::Entity entity) const;
    const gpu::Program& program_for(const gpu::ProgramDesc& desc);

    struct CompiledProgram {
        gpu::ProgramDesc desc;
        gpu::Program program;
    };

    glm::dmat3 xyz_to_working_;
    glm::dmat3 rec709_to_working_;
    gpu::ShaderLibrary library_;
    std::vector<std::unique_ptr<MaterialType>> types_;
    std::map<std::string, CompiledProgram> programs_;
    gpu::VertexArray no_vertices_;
    gpu::Buffer frame_buffer_;
    gpu::Buffer object_buffer_;
    gpu::Texture brdf_table_;
    std::optional<Environment> environment_;

    lighting::ShLight probe_sh_;
    FrameLight light_;
    glm::vec3 key_direction_{0.0F, 1.0F, 0.0F};
    glm::vec3 key_irradiance_{0.0F};  ///< working space
};

}  // namespace rowland::render
