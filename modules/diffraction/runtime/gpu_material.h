#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "engine/gpu/buffer.h"
#include "engine/gpu/program.h"
#include "engine/render/material.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/runtime/gpu_kernel.h"
#include "modules/diffraction/runtime/groove_map.h"
#include "modules/diffraction/runtime/surface_light.h"

namespace rowland::diffraction {

class GpuMaterial;

/// What a representation keeps for one object besides its vertices' light.
struct ObjectData {
    virtual ~ObjectData() = default;
};

/// Component: what is kept for one object with a grating, and what it was made for.
struct SurfaceState {
    std::shared_ptr<const GpuMaterial> material;
    std::shared_ptr<const scene::Mesh> mesh;
    glm::mat3 orientation{0.0F};
    float groove_rotation = 0.0F;
    std::shared_ptr<const GrooveMap> grooves;
    std::uint64_t light_version = 0;

    gpu::Buffer vertex_light;          ///< per vertex; of representations that have some
    std::unique_ptr<ObjectData> data;  ///< of representations that have some
};

/// An object with a grating as it is in this frame.
struct SurfaceObject {
    const scene::Mesh& mesh;  ///< as posed
    glm::mat4 object_to_world{1.0F};
    double groove_rotation = 0.0;  ///< radians, from the tangent toward the bitangent
    bool skinned = false;
    bool changed = true;       ///< since the last frame: light, orientation, mesh, rotation or material
    int slices_per_frame = 0;  ///< most of a map that one frame may fill or upload
};

/// A cooked material on the GPU, shaded as its representation is: what one class per representation implements.
class GpuMaterial {
 public:
    virtual ~GpuMaterial() = default;
    GpuMaterial(const GpuMaterial&) = delete;
    GpuMaterial& operator=(const GpuMaterial&) = delete;

    /// The engine's surface under the grating.
    const render::StandardMaterial& base() const { return base_; }
    /// What it was made of.
    const std::shared_ptr<const CookedMaterial>& cooked() const { return cooked_; }
    /// Name of the illuminant that the tables are baked for.
    const std::string& illuminant() const { return cooked_->material.quality.illuminant.name; }

    /// Once a frame for each object, before it is drawn.
    virtual void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const = 0;
    /// Whether the object, as last updated, is shaded by something else until its map is filled.
    virtual bool filling(const SurfaceState&) const { return false; }

    gpu::ProgramDesc program(const SurfaceState& state) const;
    /// The program is in use.
    void bind(const gpu::Program& program, const SurfaceLight& light, const SurfaceState& state) const;

    /// The light that is not shaded light by light.
    LightShare light_share() const {
        if (key_lights_) return LightShare::Rest;
        return separate_lights_ ? LightShare::Probe : LightShare::Whole;
    }

 protected:
    GpuMaterial(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working);

    /// The representation's shader files and defines.
    virtual void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const = 0;
    virtual void bind_tables(const gpu::Program& program, const SurfaceState& state) const = 0;

 private:
    std::shared_ptr<const CookedMaterial> cooked_;
    render::StandardMaterial base_;
    glm::vec3 mirror_weight_{0.0F};
    glm::vec3 base_weight_{1.0F};
    bool key_lights_;
    bool separate_lights_;  ///< directional lights are shaded light by light
    bool lights_at_vertices_;
    GpuKernel kernel_;
};

/// `xyz_to_working` as the renderer's.
std::shared_ptr<const GpuMaterial> make_gpu_material(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working);

/// Sets shader files by their paths below modules/diffraction/.
void set_shaders(gpu::ProgramDesc& desc, const char* vertex, const char* fragment);
/// The same of a program whose vertices are shaded.
void set_vertex_shader(gpu::ProgramDesc& desc, const char* vertex);

}  // namespace rowland::diffraction
