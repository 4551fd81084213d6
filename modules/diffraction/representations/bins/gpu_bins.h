#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "modules/diffraction/runtime/vertex_shaded.h"

namespace rowland::diffraction {

/// Fixed wavelength bins: bins.vert.glsl.
class GpuBins final : public VertexShaded {
 public:
    GpuBins(const CookedMaterial& cooked, const BinTable& table, const glm::dmat3& xyz_to_working);

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    std::size_t bins_;
    std::vector<glm::vec3> columns_;  ///< three of each bin's colour matrix
};

}  // namespace rowland::diffraction
