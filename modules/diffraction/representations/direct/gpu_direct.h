#pragma once

#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::diffraction {

/// Analytic lights and key lights alone: direct.frag.glsl.
class GpuDirect final : public GpuMaterial {
 public:
    GpuDirect(const CookedMaterial& cooked, const DirectTables&, const glm::dmat3& xyz_to_working)
        : GpuMaterial(cooked, xyz_to_working) {}

    void update(const SurfaceObject&, SurfaceLight&, SurfaceState&) const override {}

 private:
    void describe(const SurfaceState&, gpu::ProgramDesc& desc) const override {
        set_shaders(desc, "shaders/pixel_shaded.vert.glsl", "representations/direct/direct.frag.glsl");
    }
    void bind_tables(const gpu::Program&, const SurfaceState&) const override {}
};

}  // namespace rowland::diffraction
