#pragma once

#include <memory>

#include "engine/gpu/texture.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::diffraction {

/// An image in place of a representation: the radiance of the listed orders under the whole probe, computed elsewhere
/// for the current view. The scene's other lights are shaded as with any material. shaders/still.frag.glsl.
class GpuStill final : public GpuMaterial {
 public:
    /// `still` covers the viewport, row 0 at the bottom: XYZ and alpha 1 where it is known, else 0. `cooked`: its
    /// material.
    GpuStill(const CookedMaterial& cooked, std::shared_ptr<const gpu::Texture> still, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject&, SurfaceLight&, SurfaceState&) const override {}

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    std::shared_ptr<const gpu::Texture> still_;
};

}  // namespace rowland::diffraction
