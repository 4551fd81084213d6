#pragma once

#include <memory>

#include "engine/gpu/texture.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::diffraction {

/// A picture in place of a representation: what someone computed of the listed orders under the probe, all of it, as
/// seen from where the eye is. The scene's other lights are shaded as ever. shaders/still.frag.glsl.
class GpuStill final : public GpuMaterial {
 public:
    /// `still` covers the whole picture, row 0 at its bottom: XYZ, and alpha 1 where it is known, else all 0. `cooked`:
    /// the material it is of.
    GpuStill(const CookedMaterial& cooked, std::shared_ptr<const gpu::Texture> still, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject&, SurfaceLight&, SurfaceState&) const override {}

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    std::shared_ptr<const gpu::Texture> still_;
};

}  // namespace rowland::diffraction
