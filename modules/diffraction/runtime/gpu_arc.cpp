#include "modules/diffraction/runtime/gpu_arc.h"

#include <span>
#include <string>
#include <vector>

#include "engine/core/check.h"
#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

GpuArc::GpuArc(const CookedMaterial& cooked, const ArcTable& table, const glm::dmat3& xyz_to_working)
    : GpuMaterial(cooked, xyz_to_working), products_(table), weights_(table, table.grid) {
    ROWLAND_CHECK(!table.pitch, "a table over pitches needs a texture of them");
}

void GpuArc::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    if (!object.changed) return;
    const std::vector<glm::vec4> products = products_(light.harmonics(products_.bands(), light_share()), object.mesh,
                                                      object.object_to_world, object.groove_rotation);
    state.vertex_light = gpu::Buffer::of(std::span<const glm::vec4>(products));
}

void GpuArc::describe(const SurfaceState&, gpu::ProgramDesc& desc) const {
    set_shaders(desc, "arc.vert.glsl", "arc.frag.glsl");
    desc.defines.push_back({"LAYERS", std::to_string(products_.layers())});
    weights_.add_defines(desc);
}

void GpuArc::bind_tables(const gpu::Program&, const SurfaceState& state) const {
    weights_.bind();
    state.vertex_light.bind_storage(kVertexLightBinding);
}

}  // namespace rowland::diffraction
