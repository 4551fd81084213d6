#pragma once

#include <memory>
#include <optional>

#include "modules/diffraction/representations/circle/circle_filling.h"
#include "modules/diffraction/representations/circle/circle_map.h"
#include "modules/diffraction/runtime/gpu_map.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::diffraction {

/// One map for all objects of a material: shaders/circle_map.glsl. It is filled when the probe is another one, never
/// for what objects do, beside the frames that are drawn: until it is there the map of the last probe is shown, and for
/// the first one lights of their own alone. Where a frame may fill whole maps, it waits.
class GpuCircle final : public GpuMaterial {
 public:
    GpuCircle(const CookedMaterial& cooked, const CircleTables& tables, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;
    bool filling(const SurfaceState&) const override { return filling_ != nullptr; }

    /// How many maps were begun, and how many of them were shown.
    int fills_begun() const { return fills_begun_; }
    int fills() const { return fills_; }

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;
    void begin(const std::shared_ptr<const lighting::LightSamples>& texels) const;

    bool map_at_vertices_;
    CircleMapSize size_;
    KernelTable kernel_;
    double pitch_nm_;
    glm::dmat3 zero_order_xyz_;

    // The light's side of the material, which its first object in a frame brings up to date.
    mutable std::optional<std::shared_ptr<const lighting::LightSamples>> texels_;  ///< that the newest map is of
    mutable std::unique_ptr<CircleFilling> filling_;
    mutable std::optional<GpuMap> map_;
    mutable int charts_ = 1;
    mutable int fills_begun_ = 0;
    mutable int fills_ = 0;
};

}  // namespace rowland::diffraction
