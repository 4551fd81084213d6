#pragma once

#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/gpu_table.h"

namespace rowland::diffraction {

/// Representations that shade vertices from a view table and the light's SH in each vertex's tangent frame.
class VertexShaded : public GpuMaterial {
 public:
    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;

 protected:
    VertexShaded(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working, int bands, GpuTable table,
                 const char* vertex_shader);

    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

 private:
    int bands_;
    GpuTable table_;
    const char* vertex_shader_;
};

}  // namespace rowland::diffraction
