#pragma once

#include <memory>

#include "modules/diffraction/representations/circle/circle_map.h"
#include "modules/diffraction/runtime/gpu_map.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::diffraction {

/// GpuCircle's data of an object.
struct CircleData final : ObjectData {
    std::shared_ptr<const scene::Mesh> mesh;  ///< of `flat`
    bool flat = false;                        ///< so is its mirror, which needs no average over the pixel
};

/// One map for all objects of a material: circle.glsl. It follows the probe; objects do not matter.
class GpuCircle final : public GpuMaterial {
 public:
    GpuCircle(const CookedMaterial& cooked, const CircleTables& tables, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;
    bool filling(const SurfaceState&) const override { return !map_.is_complete(); }

    const MapFilling& map() const { return map_; }

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    CircleMapSize size_;
    int charts_;
    std::shared_ptr<const FillMap> fill_;
    mutable MapFilling map_;  ///< updated by the first object in a frame
};

}  // namespace rowland::diffraction
