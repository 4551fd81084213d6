#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/gpu/buffer.h"
#include "engine/gpu/context.h"
#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "engine/render/material.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/runtime/analytic_lights.h"
#include "modules/diffraction/runtime/groove_map.h"
#include "modules/diffraction/runtime/map_cache.h"
#include "modules/diffraction/runtime/surface_light.h"

namespace rowland::diffraction {

class GpuMaterial;

/// Component: the data of one object with a grating, and their cache key.
struct SurfaceState {
    std::shared_ptr<const GpuMaterial> material;
    bool mean_colour = false;  ///< it has one colour for all views, the mean over them
    std::shared_ptr<const scene::Mesh> mesh;
    glm::mat3 orientation{0.0F};
    float groove_rotation = 0.0F;
    std::shared_ptr<const GrooveMap> grooves;
    std::size_t probe = 0;                               ///< index of the frame's light
    std::shared_ptr<const std::uint64_t> light_version;  ///< SurfaceLight::version()
    bool changed = true;                                 ///< since it was last updated
    bool seen = false;                                   ///< in the last frame

    std::optional<glm::dvec3> flat;    ///< normal of the lit side of a flat mesh without a skin, object axes
    std::optional<glm::vec4> tangent;  ///< common_tangent() on that side

    gpu::StreamBuffer vertex_light;  ///< per vertex; may be empty
    glm::vec3 arc_e1{0.0F};          ///< of GpuArc: ArcTurns
    glm::vec3 arc_e2{0.0F};
    ObjectMap map;
    bool without_map = false;                 ///< drawn without one: it is not filled yet, or there can be none
    std::unique_ptr<SurfaceState> reflected;  ///< of GpuMaterial::reflected(), or null
    std::unique_ptr<SurfaceState> second;     ///< under the second probe, or of the rung that fades in; or null
    bool fades = false;                       ///< `second` is of another rung

    /// The state of a slot. Without `second`, as of an object that was never seen, one state serves both slots.
    SurfaceState& in(render::ProbeSlot slot) { return slot == render::ProbeSlot::Second && second ? *second : *this; }
};

/// An object with a grating in this frame.
struct SurfaceObject {
    const scene::Mesh& mesh;  ///< as posed
    glm::mat4 object_to_world{1.0F};
    double groove_rotation = 0.0;  ///< radians, from the tangent toward the bitangent
    bool skinned = false;
    bool changed = true;  ///< since the last frame: light, orientation, mesh, rotation or material
    MapCache& maps;
    bool may_wait = true;  ///< whether the frame may wait for the object's first map
};

/// A cooked material on the GPU. One class per representation implements it.
class GpuMaterial {
 public:
    virtual ~GpuMaterial() = default;
    GpuMaterial(const GpuMaterial&) = delete;
    GpuMaterial& operator=(const GpuMaterial&) = delete;

    /// The engine's surface under the grating.
    const render::StandardMaterial& base() const { return base_; }
    const std::shared_ptr<const CookedMaterial>& cooked() const { return cooked_; }
    /// Whether it is a sheet, which shows the light behind it.
    bool transmits() const { return cooked_->material.grating.transmission.has_value(); }
    /// What else a sheet reflects, drawn over it; null: nothing.
    const std::shared_ptr<const GpuMaterial>& reflected() const { return reflected_; }
    /// Name of the illuminant that the tables are baked for.
    const std::string& illuminant() const { return cooked_->material.quality.illuminant.name; }

    /// Call once per frame for each object that is seen, before it is drawn.
    virtual void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const = 0;

    gpu::ProgramDesc program(const SurfaceState& state) const;
    /// Key of the material and of what program() depends on in the state; not 0.
    std::uint64_t program_key(const SurfaceState& state) const;
    /// Key of what bind() reads of the state; 0: of what one object alone has.
    std::uint64_t binding_key(const SurfaceState& state) const;
    /// The program must be in use.
    void bind(const gpu::Program& program, const SurfaceLight& light, const SurfaceState& state) const;

 protected:
    GpuMaterial(std::shared_ptr<const CookedMaterial> cooked, const glm::dmat3& xyz_to_working);

    /// The SH and the samples of the light that is not shaded light by light.
    const lighting::ShLight& harmonics(SurfaceLight& light, int bands) const {
        return separate_lights_ ? light.probe_harmonics(bands, key_lights_) : light.whole_harmonics(bands);
    }
    const std::shared_ptr<const lighting::LightSamples>& samples(const SurfaceLight& light) const {
        return light.probe_samples(key_lights_);
    }

    /// The representation's shader file and defines.
    virtual void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const = 0;
    virtual void bind_tables(const gpu::Program& program, const SurfaceState& state) const = 0;
    /// Whether objects with one map, or without maps, have the same tables: nothing of them is computed for each.
    virtual bool has_common_tables(const SurfaceState& /*state*/) const { return false; }
    /// What the vertex stage reads.
    struct VertexLight {
        int blocks = 1;          ///< storage buffers
        std::size_t bytes = 0;   ///< of a storage buffer, per vertex
        std::size_t texels = 0;  ///< of a buffer texture, per vertex
    };
    /// Throws Error (system) if the GPU cannot read that much.
    void require_vertex_light(const SurfaceObject& object, const VertexLight& light) const;

 private:
    void add_defines(const SurfaceState& state, gpu::ProgramDesc& desc) const;
    bool shades_key_lights(const gpu::ProgramDesc& desc) const;
    bool key_windows(const SurfaceState& state) const;
    std::string key_light_shader(const SurfaceState& state) const;

    std::uint64_t number_;  ///< another for each material
    std::shared_ptr<const CookedMaterial> cooked_;
    std::shared_ptr<const GpuMaterial> reflected_;
    gpu::Limits limits_ = gpu::read_limits();
    render::StandardMaterial base_;
    glm::vec3 mirror_weight_{0.0F};
    glm::vec3 base_weight_{1.0F};
    glm::vec3 reflectance_{0.0F};
    bool even_kernel_;      ///< k(−x) = k(x)
    int key_lights_;        ///< the most that are shaded light by light
    bool separate_lights_;  ///< directional lights are shaded light by light
    bool lights_at_vertices_;
    GpuKernel kernel_;
    std::optional<GpuPattern> pattern_;  ///< of a lattice, instead of the kernel
};

/// `xyz_to_working` as the renderer's.
std::shared_ptr<const GpuMaterial> make_gpu_material(std::shared_ptr<const CookedMaterial> cooked,
                                                     const glm::dmat3& xyz_to_working);
inline std::shared_ptr<const GpuMaterial> make_gpu_material(CookedMaterial cooked, const glm::dmat3& xyz_to_working) {
    return make_gpu_material(std::make_shared<const CookedMaterial>(std::move(cooked)), xyz_to_working);
}

/// Names the shader file, below modules/diffraction/, that gives the light from the probe at the pixels. `samplers`:
/// the number that it declares.
void set_pixel_shader(gpu::ProgramDesc& desc, const char* file, int samplers = 1);
/// The same at the vertices.
void set_vertex_shader(gpu::ProgramDesc& desc, const char* file);

/// An image in place of a representation: the radiance of the listed orders under the whole probe, computed elsewhere
/// for the current view. The scene's other lights are shaded as with any material. shaders/picture.glsl.
class GpuPicture final : public GpuMaterial {
 public:
    /// `picture` covers the viewport, row 0 at the bottom: XYZ and alpha 1 where it is known, else 0. `cooked`: its
    /// material.
    GpuPicture(const CookedMaterial& cooked, std::shared_ptr<const gpu::Texture> picture,
               const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject&, SurfaceLight&, SurfaceState&) const override {}

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    std::shared_ptr<const gpu::Texture> picture_;
};

}  // namespace rowland::diffraction
