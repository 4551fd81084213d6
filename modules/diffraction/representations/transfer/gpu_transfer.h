#pragma once

#include "modules/diffraction/runtime/vertex_shaded.h"

namespace rowland::diffraction {

/// SH coefficients with the wavelengths summed: transfer.vert.glsl.
class GpuTransfer final : public VertexShaded {
 public:
    GpuTransfer(const CookedMaterial& cooked, const TransferTable& table, const glm::dmat3& xyz_to_working)
        : VertexShaded(cooked, xyz_to_working, table.bands, GpuTable(table, table.grid),
                       "representations/transfer/transfer.vert.glsl") {}
};

}  // namespace rowland::diffraction
