#pragma once

#include "engine/gpu/texture.h"
#include "modules/diffraction/runtime/vertex_shaded.h"

namespace rowland::diffraction {

/// The paper's representation: spikes.vert.glsl.
class GpuSpikes final : public VertexShaded {
 public:
    GpuSpikes(const CookedMaterial& cooked, const SpikeTable& table, const glm::dmat3& xyz_to_working);

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    int spikes_;
    gpu::Texture wavelengths_;
};

}  // namespace rowland::diffraction
