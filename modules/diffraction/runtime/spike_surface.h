#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "engine/lighting/sh_light.h"
#include "engine/math/sh_window.h"
#include "engine/render/material.h"
#include "modules/diffraction/runtime/gpu_spike_material.h"

namespace rowland::diffraction {

/// Component: a surface with a grating, shaded by the paper's spikes.
struct SpikeSurface {
    std::shared_ptr<const GpuSpikeMaterial> material;
};

/// Draws entities that have a SpikeSurface; keeps each one's light in its vertices' frames, rotated anew only when the
/// light or the object has turned.
class SpikeSurfaceType final : public render::MaterialType {
 public:
    /// `window` tames the ringing of band-limited light; nothing stands for the mildest one that does.
    explicit SpikeSurfaceType(std::optional<math::SphericalWindow> window) : window_(window) {}

    void add_shaders(gpu::ShaderLibrary& library) const override;
    bool owns(ecs::World& world, ecs::Entity entity) const override;
    gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity) const override;
    void update(ecs::World& world, const render::FrameLight& light) override;
    void bind(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const override;

 private:
    /// The light in so many bands, windowed; kept until the light changes.
    const lighting::ShLight& windowed(const render::FrameLight& light, int bands);

    std::optional<math::SphericalWindow> window_;
    std::uint64_t light_version_ = 0;
    std::map<int, lighting::ShLight> windowed_;  ///< by bands
};

}  // namespace rowland::diffraction
