#include "modules/diffraction/runtime/vertex_shaded.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/math/sh_basis.h"
#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/tangent_light.h"

namespace rowland::diffraction {

VertexShaded::VertexShaded(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working, int bands, GpuTable table,
                           const char* vertex_shader)
    : GpuMaterial(cooked, xyz_to_working), bands_(bands), table_(std::move(table)), vertex_shader_(vertex_shader) {}

void VertexShaded::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    if (!object.changed) return;
    require_vertex_light(object, {.texels = static_cast<std::size_t>(math::sh_count(bands_))});
    const std::vector<float> rotated = rotate_to_vertices(light.harmonics(bands_, light_part()), object.mesh,
                                                          object.object_to_world, object.groove_rotation);
    state.vertex_light.write_values(std::span<const float>(rotated));
}

void VertexShaded::describe(const SurfaceState&, gpu::ProgramDesc& desc) const {
    set_vertex_shader(desc, vertex_shader_);
    desc.defines.push_back({"BANDS", std::to_string(bands_)});
    table_.add_defines(desc);
}

void VertexShaded::bind_tables(const gpu::Program&, const SurfaceState& state) const {
    table_.bind();
    state.vertex_light.bind_texels(kVertexLightUnit);
}

}  // namespace rowland::diffraction
