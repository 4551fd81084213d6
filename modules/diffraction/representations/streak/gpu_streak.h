#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "modules/diffraction/representations/arc/gpu_arc.h"
#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/radiance_cube.h"

namespace rowland::diffraction {

/// The mirror-like part of a narrow lobe from the whole probe, and an arc table for what it leaves of Stam's pits:
/// shaders/streak.frag.glsl.
class GpuStreak final : public GpuMaterial {
 public:
    GpuStreak(const CookedMaterial& cooked, const StreakTables& tables, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    gpu::Buffer nodes_;
    std::vector<glm::vec3> taps_;  ///< offset and width in s_h, share
    float power_;                  ///< what the streak's sum is multiplied with
    float rest_share_;
    std::optional<GpuArc> rest_;

    mutable std::shared_ptr<const RadianceCube> radiance_;  ///< the light's, as of the last update
};

}  // namespace rowland::diffraction
