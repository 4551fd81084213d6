#pragma once

#include <memory>
#include <optional>

#include "engine/core/computed.h"
#include "modules/diffraction/representations/circle/circle_map.h"
#include "modules/diffraction/runtime/gpu_map.h"
#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/map_upload.h"

namespace rowland::diffraction {

/// One map for all objects of a material: circle_map.glsl. A change of the probe fills it again, in the background;
/// objects do not matter. Meanwhile the last probe's map is shown, or before the first map analytic lights alone. If a
/// frame may fill whole maps, it waits for the map.
class GpuCircle final : public GpuMaterial {
 public:
    GpuCircle(const CookedMaterial& cooked, const CircleTables& tables, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;
    bool filling(const SurfaceState&) const override { return filling_.busy() || upload_; }

    /// Number of maps begun, and of maps uploaded.
    int fills_begun() const { return fills_begun_; }
    int fills() const { return fills_; }

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    bool describe_other(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void describe_map(gpu::ProgramDesc& desc) const;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    using Texels = std::shared_ptr<const lighting::LightSamples>;
    using Filling = Computed<Texels, std::shared_ptr<MapTexels>>;
    void begin(const Texels& texels) const;
    void take_over(const Filling::Change& change) const;

    CircleMapSize size_;
    int charts_;

    // Updated by the first object in a frame.
    mutable std::optional<Texels> texels_;  ///< of the newest map
    mutable Filling filling_;
    mutable std::optional<MapUpload> upload_;
    mutable std::optional<GpuMap> map_;
    mutable int fills_begun_ = 0;
    mutable int fills_ = 0;
};

}  // namespace rowland::diffraction
