#pragma once

#include <memory>
#include <optional>

#include "modules/diffraction/representations/streak/streak_map.h"
#include "modules/diffraction/runtime/gpu_arc.h"
#include "modules/diffraction/runtime/gpu_map.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::diffraction {

/// The streak of a narrow lobe from a map of the whole probe, and an arc table for the incoherent part of Stam's pits:
/// streak.glsl. One map for all objects of a material; it follows the
/// probe.
class GpuStreak final : public GpuMaterial {
 public:
    GpuStreak(const CookedMaterial& cooked, const StreakTables& tables, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;
    bool filling(const SurfaceState&) const override { return !map_.is_complete(); }

    const MapFilling& map() const { return map_; }

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    gpu::Buffer segments_;
    float reach_;  ///< Streak::reach()
    float level_;  ///< log2 of the lobe's deviation over the map's
    float power_;  ///< scale of the streak's sum
    float rest_weight_;
    std::optional<GpuArc> rest_;

    std::shared_ptr<const FillMap> fill_;
    mutable MapFilling map_;  ///< updated by the first object in a frame
};

}  // namespace rowland::diffraction
