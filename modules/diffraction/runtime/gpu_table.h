#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "modules/diffraction/bake/packed_texels.h"
#include "modules/diffraction/bake/view_mapping.h"

namespace rowland::diffraction {

/// A view table on the GPU: shaders/packed_table.glsl.
class GpuTable {
 public:
    /// As many layers as `packed` has scales.
    GpuTable(const PackedTexels& packed, const ViewGrid& grid);

    void add_defines(gpu::ProgramDesc& desc) const;
    void bind() const;

 private:
    ViewMapping mapping_;
    int columns_;
    int rows_;
    gpu::Texture texture_;
    gpu::Buffer ranges_;
};

}  // namespace rowland::diffraction
