#pragma once

#include <memory>
#include <optional>

#include "modules/diffraction/representations/arc/gpu_arc.h"
#include "modules/diffraction/representations/streak/streak_filling.h"
#include "modules/diffraction/runtime/gpu_map.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::diffraction {

/// The streak of a narrow lobe from a map of the whole probe, and an arc table for the incoherent rest of Stam's pits:
/// streak.frag.glsl. One map for all objects of a material. A change of the probe fills it again, in the background;
/// meanwhile the last probe's map is shown, or before the first map no streak. If a frame may fill whole maps, it waits
/// for the map.
class GpuStreak final : public GpuMaterial {
 public:
    GpuStreak(const CookedMaterial& cooked, const StreakTables& tables, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;
    bool filling(const SurfaceState&) const override { return filling_ != nullptr; }

    /// Number of maps begun, and of maps uploaded.
    int fills_begun() const { return fills_begun_; }
    int fills() const { return fills_; }

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;
    void begin(const std::shared_ptr<const lighting::LightSamples>& texels) const;

    gpu::Buffer segments_;
    StreakMapSize size_;
    float reach_;  ///< Streak::reach()
    float level_;  ///< log2 of the lobe's deviation over the map's
    float power_;  ///< scale of the streak's sum
    float rest_weight_;
    std::optional<GpuArc> rest_;

    // Updated by the first object in a frame.
    mutable std::optional<std::shared_ptr<const lighting::LightSamples>> texels_;  ///< of the newest map
    mutable std::unique_ptr<StreakFilling> filling_;
    mutable GpuMap map_;
    mutable int fills_begun_ = 0;
    mutable int fills_ = 0;
};

}  // namespace rowland::diffraction
