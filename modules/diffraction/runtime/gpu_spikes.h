#pragma once

#include "engine/gpu/texture.h"
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

/// The paper's representation: spikes.glsl.
class GpuSpikes final : public VertexShaded {
 public:
    GpuSpikes(const CookedMaterial& cooked, const SpikeTable& table, const glm::dmat3& xyz_to_working);

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    int spikes_;
    gpu::Texture wavelengths_;
};

/// SH coefficients with the wavelengths summed: transfer.glsl.
class GpuTransfer final : public VertexShaded {
 public:
    GpuTransfer(const CookedMaterial& cooked, const TransferTable& table, const glm::dmat3& xyz_to_working)
        : VertexShaded(cooked, xyz_to_working, table.bands, GpuTable(table, table.grid),
                       "representations/transfer/transfer.glsl") {}
};

}  // namespace rowland::diffraction
