#pragma once

#include "modules/diffraction/runtime/arc_products.h"
#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/gpu_table.h"

namespace rowland::diffraction {

/// Arc moments or SH at the vertices, a short sum over ranks in the pixels: shaders/arc.*.
class GpuArc final : public GpuMaterial {
 public:
    GpuArc(const CookedMaterial& cooked, const ArcTable& table, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

 private:
    ArcProducts products_;
    GpuTable weights_;
};

}  // namespace rowland::diffraction
