#include "modules/diffraction/representations/planar/gpu_planar.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <string>

#include "engine/core/log.h"
#include "modules/diffraction/runtime/flatness.h"

namespace rowland::diffraction {

namespace {

/// Smaller changes of the normal do not show at the map's resolution.
constexpr double kSameNormal = 1e-5;

PlanarData& data_of(SurfaceState& state) {
    if (!state.data) state.data = std::make_unique<PlanarData>();
    return static_cast<PlanarData&>(*state.data);
}

const PlanarData& data_of(const SurfaceState& state) {
    return static_cast<const PlanarData&>(*state.data);
}

std::optional<glm::dvec3> in_world(const std::optional<glm::dvec3>& normal, const glm::mat4& object_to_world) {
    if (!normal) return std::nullopt;
    return glm::normalize(glm::inverseTranspose(glm::dmat3(object_to_world)) * *normal);
}

bool same(const std::optional<glm::dvec3>& a, const std::optional<glm::dvec3>& b) {
    return a.has_value() == b.has_value() && (!a || glm::length(*a - *b) <= kSameNormal);
}

}  // namespace

GpuPlanar::GpuPlanar(const CookedMaterial& cooked, const PlanarTables& tables, const glm::dmat3& xyz_to_working)
    : GpuMaterial(cooked, xyz_to_working),
      stand_in_(cooked, tables.stand_in, xyz_to_working),
      size_(tables.size),
      mapper_(tables.lobe ? std::make_shared<const LobeMapper>(*tables.lobe, xyz_to_working) : nullptr) {}

void GpuPlanar::find_flatness(const SurfaceObject& object, const SurfaceState& state, PlanarData& data) const {
    if (data.mesh == state.mesh && state.mesh) return;
    data.mesh = state.mesh;
    data.flat = object.skinned ? std::nullopt : flat_normal(object.mesh);
    if (!data.flat && !object.skinned)
        log_warning("a grating of representation planar is on a mesh that is not flat: it is shaded as arc");
}

void GpuPlanar::want(const std::optional<glm::dvec3>& normal, const SurfaceLight& light, PlanarData& data) const {
    if (same(data.normal, normal) && data.texels == light.texels(light_part())) {
        data.at_rest = true;
        return;
    }
    data.at_rest = !data.normal;  // the first map need not wait
    data.normal = normal;
    data.texels = light.texels(light_part());
    data.fill.reset();
    data.on_gpu.reset();
}

void GpuPlanar::fill(int slices, PlanarData& data) const {
    if (!data.fill) {
        data.fill.emplace(*data.texels, working_kernel(), cooked()->material.grating.pitch_nm, *data.normal, size_,
                          working_zero_order(), cooked()->material.grating.cover);
        data.map = data.fill->empty();
        data.filled = 0;
        ++data.fills_begun;
    }
    const int end = std::min(size_.azimuths, data.filled + std::max(1, slices));
    data.fill->fill(data.filled, end, data.map);
    data.azimuths_filled += end - data.filled;
    data.filled = end;
    if (end < size_.azimuths) return;
    data.on_gpu.emplace(data.map.xyz, gpu::TextureDesc{.width = data.map.azimuths, .height = data.map.views},
                        gpu::Sampling{.filter = gpu::Filter::Linear, .wrap_s = gpu::Wrap::Repeat});
    data.fill.reset();
    data.map.xyz.clear();
}

void GpuPlanar::update_map(const SurfaceObject& object, SurfaceLight& light, PlanarData& data) const {
    const std::optional<glm::dvec3> normal = in_world(data.flat, object.object_to_world);
    if (!mapper_) {
        want(normal, light, data);
        if (data.normal && data.texels && data.at_rest && !data.on_gpu) fill(object.slices_per_frame, data);
        return;
    }
    if (!same(data.normal, normal)) data.normal = normal;
    data.texels = light.texels(light_part());
    if (data.normal && data.texels)
        data.lobe.update({.texels = data.texels, .normal = *data.normal}, mapper_, object.slices_per_frame);
}

void GpuPlanar::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    PlanarData& data = data_of(state);
    find_flatness(object, state, data);
    update_map(object, light, data);
    data.stand_in_is_old = data.stand_in_is_old || object.changed;
    if (has_map(data) || !data.stand_in_is_old) return;
    SurfaceObject changed = object;
    changed.changed = true;
    stand_in_.update(changed, light, state);
    data.stand_in_is_old = false;
}

bool GpuPlanar::filling(const SurfaceState& state) const {
    const PlanarData& data = data_of(state);
    return data.normal && data.texels && !(mapper_ ? data.lobe.is_complete() : data.on_gpu.has_value());
}

void GpuPlanar::describe(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    if (has_map(data_of(state)))
        describe_map(state, desc);
    else
        stand_in_.describe(state, desc);
}

bool GpuPlanar::describe_other(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    if (has_map(data_of(state)))
        stand_in_.describe(state, desc);
    else
        describe_map(state, desc);
    return true;
}

void GpuPlanar::describe_map(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    // The vertices do not read a groove texture.
    if (cooked()->material.quality.map_at_vertices && !state.grooves)
        set_vertex_shader(desc, "representations/planar/planar.vert.glsl");
    else
        set_shaders(desc, "shaders/pixel_shaded.vert.glsl", "representations/planar/planar.frag.glsl");
    if (mapper_) {
        desc.defines.push_back({"LOBE_MAP", "1"});
        if (mapper_->full().spectrum.even()) desc.defines.push_back({"HALF_TURN", "1"});
        return;
    }
    desc.defines.push_back({"AZIMUTHS", std::to_string(size_.azimuths)});
    desc.defines.push_back({"VIEWS", std::to_string(size_.views)});
}

void GpuPlanar::bind_tables(const gpu::Program& program, const SurfaceState& state) const {
    const PlanarData& data = data_of(state);
    if (!has_map(data)) return stand_in_.bind_tables(program, state);
    if (mapper_) return data.lobe.bind(program);
    data.on_gpu->bind(program);
    program.set("planar_e1", glm::vec3(data.map.e1));
    program.set("planar_e2", glm::vec3(data.map.e2));
}

}  // namespace rowland::diffraction
