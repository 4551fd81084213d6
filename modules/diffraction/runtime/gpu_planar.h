#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>

#include "engine/core/parallel.h"
#include "modules/diffraction/representations/planar/planar.h"
#include "modules/diffraction/representations/point_shader.h"
#include "modules/diffraction/runtime/gpu_arc.h"
#include "modules/diffraction/runtime/gpu_map.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::diffraction {

/// GpuPlanar's data of an object.
struct PlanarData final : ObjectData {
    std::shared_ptr<const scene::Mesh> mesh;  ///< of `flat`
    std::optional<glm::dvec3> flat;           ///< the mesh's normal, in its own axes
    std::optional<glm::vec4> tangent;         ///< of its mesh, if all agree
    glm::dvec3 normal{0.0};                   ///< of the map, in the world
    std::optional<glm::dvec3> grating;        ///< the same, if it has one azimuth
    bool has_map = false;                     ///< the mesh is flat and the probe has texels
    MapFilling map;
    bool stand_in_is_old = true;  ///< the stand-in's vertex data are out of date
};

/// One map for each flat object: planar_map.glsl. It follows the object's normal and the probe; a rotation about the
/// normal leaves it valid, unless it is over v_g and v_h alone, as all points have one g. An arc table shades objects
/// that are not flat, and without a probe's texels.
class GpuPlanar final : public GpuMaterial {
 public:
    GpuPlanar(const CookedMaterial& cooked, const PlanarTables& tables, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;
    bool filling(const SurfaceState& state) const override;

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    void find_flatness(const SurfaceObject& object, const SurfaceState& state, PlanarData& data) const;
    void update_map(const SurfaceObject& object, const SurfaceLight& light, bool grooves, PlanarData& data) const;

    Lazy<std::unique_ptr<const GpuArc>> stand_in_;
    std::shared_ptr<const FillMap> fill_;
    bool lobe_map_;   ///< of a lobe that is not flat
    bool half_turn_;  ///< such a map has half of the azimuths
    bool pitch_axis_;
};

/// Fills the maps of a material's objects: planar_map.glsl. `material`: in the working space.
std::shared_ptr<const FillMap> planar_filling(const PlanarTables& tables, const MaterialKernel& material,
                                              const glm::dmat3& xyz_to_working);

}  // namespace rowland::diffraction
