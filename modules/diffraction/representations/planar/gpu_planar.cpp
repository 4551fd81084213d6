#include "modules/diffraction/representations/planar/gpu_planar.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <string>

#include "engine/core/log.h"
#include "modules/diffraction/representations/planar/planar_filling.h"
#include "modules/diffraction/runtime/flatness.h"
#include "modules/diffraction/runtime/tangent_light.h"

namespace rowland::diffraction {

namespace {

/// Smaller changes of a map's axes do not show at its resolution.
constexpr double kSameAxis = 1e-5;

PlanarData& data_of(SurfaceState& state) {
    if (!state.data) state.data = std::make_unique<PlanarData>();
    return static_cast<PlanarData&>(*state.data);
}

const PlanarData& data_of(const SurfaceState& state) {
    return static_cast<const PlanarData&>(*state.data);
}

glm::dvec3 in_world(const glm::dvec3& normal, const glm::mat4& object_to_world) {
    return glm::normalize(glm::inverseTranspose(glm::dmat3(object_to_world)) * normal);
}

void follow(const glm::dvec3& axis, glm::dvec3& followed) {
    if (glm::length(followed - axis) > kSameAxis) followed = axis;
}

}  // namespace

GpuPlanar::GpuPlanar(const CookedMaterial& cooked, const PlanarTables& tables, const glm::dmat3& xyz_to_working)
    : GpuMaterial(cooked, xyz_to_working),
      stand_in_([material = this->cooked(), table = tables.stand_in, xyz_to_working] {
          return std::make_unique<const GpuArc>(*material, *table, xyz_to_working);
      }),
      fill_(planar_filling(tables, working_material(), xyz_to_working)),
      lobe_map_(tables.lobe.has_value()),
      half_turn_(tables.lobe && tables.lobe->pattern.even),
      pitch_axis_(tables.size.pitch.has_value()) {}

void GpuPlanar::find_flatness(const SurfaceObject& object, const SurfaceState& state, PlanarData& data) const {
    if (data.mesh == state.mesh && state.mesh) return;
    data.mesh = state.mesh;
    data.flat = object.skinned ? std::nullopt : flat_normal(object.mesh);
    data.tangent = common_tangent(object.mesh);
    if (!data.flat && !object.skinned)
        log_warning("a grating of representation planar is on a mesh that is not flat: it is shaded as arc");
}

void GpuPlanar::update_map(const SurfaceObject& object, const SurfaceLight& light, bool grooves,
                           PlanarData& data) const {
    const auto& texels = light.texels(light_part());
    data.has_map = data.flat && texels;
    if (!data.has_map) return;
    follow(in_world(*data.flat, object.object_to_world), data.normal);
    if (lobe_map_ && !grooves && data.tangent) {
        if (!data.grating) data.grating.emplace(0.0);
        const glm::dmat3 to_tangent =
            tangent_frame(glm::vec3(*data.flat), *data.tangent, object.object_to_world, object.groove_rotation);
        follow(glm::transpose(to_tangent)[0], *data.grating);
    } else {
        data.grating.reset();
    }
    data.map.update({.texels = texels, .normal = data.normal, .grating = data.grating}, fill_, object.map_pace);
}

void GpuPlanar::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    PlanarData& data = data_of(state);
    find_flatness(object, state, data);
    update_map(object, light, state.grooves != nullptr, data);
    data.stand_in_is_old = data.stand_in_is_old || object.changed;
    if (data.has_map || !data.stand_in_is_old) return;
    SurfaceObject changed = object;
    changed.changed = true;
    (*stand_in_)->update(changed, light, state);
    data.stand_in_is_old = false;
}

bool GpuPlanar::filling(const SurfaceState& state) const {
    const PlanarData& data = data_of(state);
    return data.has_map && !data.map.is_complete();
}

void GpuPlanar::describe(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    if (!data_of(state).has_map) return (*stand_in_)->describe(state, desc);
    // The vertices do not read a groove texture.
    if (cooked()->material.quality.map_at_vertices && !state.grooves)
        set_vertex_shader(desc, "representations/planar/planar.vert.glsl");
    else
        set_shaders(desc, "shaders/pixel_shaded.vert.glsl", "representations/planar/planar.frag.glsl");
    if (state.grooves) desc.defines.push_back({"FINE_GROOVE_PARTS", "1"});  // each is one look-up
    if (pitch_axis_) desc.defines.push_back({"PITCH_AXIS", "1"});
    if (lobe_map_) desc.defines.push_back({"LOBE_MAP", "1"});
    if (half_turn_) desc.defines.push_back({"HALF_TURN", "1"});
}

void GpuPlanar::bind_tables(const gpu::Program& program, const SurfaceState& state) const {
    const PlanarData& data = data_of(state);
    if (data.has_map)
        data.map.bind(program);
    else
        (*stand_in_)->bind_tables(program, state);
}

}  // namespace rowland::diffraction
