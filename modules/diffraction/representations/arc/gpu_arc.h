#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "modules/diffraction/representations/arc/arc_products.h"
#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/gpu_table.h"

namespace rowland::diffraction {

/// Arc moments or SH at the vertices, a short sum over ranks in the pixels: shaders/arc.*. Under a GrooveMap a flat
/// object has them as a series over the azimuth of g, so that pixels choose their own; on others the vertices take the
/// map's rotation where they lie.
class GpuArc final : public GpuMaterial {
 public:
    GpuArc(const CookedMaterial& cooked, const ArcTable& table, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

 private:
    std::vector<glm::vec4> grooved_products(const SurfaceObject& object, const lighting::ShLight& light,
                                            SurfaceState& state) const;

    ArcProducts products_;
    GpuTable weights_;
    std::optional<glm::vec2> pitch_place_;  ///< scale and offset from log f to the weights' second coordinate
};

}  // namespace rowland::diffraction
