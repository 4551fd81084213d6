#include "modules/diffraction/representations/bins/gpu_bins.h"

#include <span>
#include <string>

namespace rowland::diffraction {

GpuBins::GpuBins(const CookedMaterial& cooked, const BinTable& table, const glm::dmat3& xyz_to_working)
    : VertexShaded(cooked, xyz_to_working, table.bands, GpuTable(table, table.grid),
                   "representations/bins/bins.vert.glsl"),
      bins_(table.colours.size()) {
    for (const glm::mat3& colour : table.colours)
        for (int c = 0; c < 3; ++c) columns_.push_back(colour[c]);
}

void GpuBins::describe(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    VertexShaded::describe(state, desc);
    desc.defines.push_back({"BINS", std::to_string(bins_)});
}

void GpuBins::bind_tables(const gpu::Program& program, const SurfaceState& state) const {
    VertexShaded::bind_tables(program, state);
    program.set("bin_colours", std::span<const glm::vec3>(columns_));
}

}  // namespace rowland::diffraction
