#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/gpu_table.h"
#include "modules/diffraction/runtime/vertex_light.h"

namespace rowland::diffraction {

/// Products of arc moments or SH at the vertices, a sum over ranks at the pixels: arc.*.glsl. Under a GrooveMap a flat
/// object has the products as a series over the azimuth of g, evaluated per pixel. On other objects the vertices are
/// rotated as the map says.
class GpuArc final : public GpuMaterial {
 public:
    GpuArc(const CookedMaterial& cooked, const ArcTable& table, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

 private:
    std::vector<glm::vec4> grooved_products(const SurfaceObject& object, const lighting::ShLight& light,
                                            SurfaceState& state) const;

    ArcProducts products_;
    GpuTable weights_;
    std::optional<PitchAxis> pitch_;
};

}  // namespace rowland::diffraction
