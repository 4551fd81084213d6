#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "modules/diffraction/representations/arc/gpu_arc.h"
#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/radiance_cube.h"

namespace rowland::diffraction {

/// The streak of a narrow lobe from the whole probe, and an arc table for the incoherent rest of Stam's pits:
/// streak.frag.glsl.
class GpuStreak final : public GpuMaterial {
 public:
    GpuStreak(const CookedMaterial& cooked, const StreakTables& tables, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    gpu::Buffer nodes_;
    std::vector<glm::vec3> taps_;  ///< offset and width in s_h; weight
    float power_;                  ///< scale of the streak's sum
    float rest_weight_;
    std::optional<GpuArc> rest_;

    mutable std::shared_ptr<const RadianceCube> radiance_;  ///< of the last update's light
};

}  // namespace rowland::diffraction
