#include "modules/diffraction/runtime/gpu_arc.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/vertex_light.h"

namespace rowland::diffraction {

namespace {

/// The plane of a flat object under a GrooveMap.
struct ArcPlane final : ObjectData {
    glm::vec3 e1{0.0F};
    glm::vec3 e2{0.0F};
};

const ArcPlane* plane_of(const SurfaceState& state) {
    return state.grooves ? dynamic_cast<const ArcPlane*>(state.data.get()) : nullptr;
}

ViewGrid weight_grid(const ArcTable& table) {
    ViewGrid grid = table.grid;
    grid.rows = table.rows();
    return grid;
}

}  // namespace

GpuArc::GpuArc(const CookedMaterial& cooked, const ArcTable& table, const glm::dmat3& xyz_to_working)
    : GpuMaterial(cooked, xyz_to_working),
      products_(table, xyz_to_working),
      weights_(table, weight_grid(table)),
      pitch_(table.pitch) {}

std::vector<glm::vec4> GpuArc::grooved_products(const SurfaceObject& object, const lighting::ShLight& light,
                                                SurfaceState& state) const {
    if (plane_of(state) != nullptr) state.data.reset();
    // If this is the stand-in of another representation, the state holds that one's data.
    const auto flat = object.skinned || state.data ? std::nullopt : flat_normal(object.mesh);
    if (!flat)
        return products_(light, turned_by(*state.grooves, object.mesh), object.object_to_world, object.groove_rotation);
    const glm::dmat3 linear(object.object_to_world);
    ArcTurns turns = arc_turns(products_, light, glm::normalize(glm::inverseTranspose(linear) * *flat));
    auto plane = std::make_unique<ArcPlane>();
    plane->e1 = turns.e1;
    plane->e2 = turns.e2;
    state.data = std::move(plane);
    return std::move(turns.terms);
}

void GpuArc::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    if (!object.changed) return;
    require_vertex_light(object, {.bytes = static_cast<std::size_t>(3 * products_.layers()) * sizeof(glm::vec4)});
    const lighting::ShLight& sh = harmonics(light, products_.bands());
    const std::vector<glm::vec4> products =
        state.grooves ? grooved_products(object, sh, state)
                      : products_(sh, object.mesh, object.object_to_world, object.groove_rotation);
    state.vertex_light.write_values(std::span<const glm::vec4>(products));
}

void GpuArc::describe(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    const bool turns = plane_of(state) != nullptr;
    set_pixel_shader(desc, "representations/arc/arc.glsl");
    if (turns)
        desc.defines.push_back({"TURNS", std::to_string(products_.bands())});
    else
        desc.defines.push_back({"ARC_PRODUCTS", "1"});
    if (pitch_ && state.grooves) desc.defines.push_back({"PITCH_AXIS", "1"});
    desc.defines.push_back({"LAYERS", std::to_string(products_.layers())});
    weights_.add_defines(desc);
}

void GpuArc::bind_tables(const gpu::Program& program, const SurfaceState& state) const {
    weights_.bind();
    state.vertex_light.bind_storage(kVertexLightBinding);
    if (pitch_) program.set("pitch_scale_bias", glm::vec2(pitch_->scale_bias()));
    if (const ArcPlane* plane = plane_of(state)) {
        program.set("arc_e1", plane->e1);
        program.set("arc_e2", plane->e2);
    }
}

}  // namespace rowland::diffraction
