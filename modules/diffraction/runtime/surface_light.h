#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "engine/gpu/buffer.h"
#include "engine/lighting/sh_light.h"
#include "engine/math/sh_window.h"
#include "engine/render/material.h"

namespace rowland::diffraction {

/// Which part of a frame's light.
enum class LightShare {
    Whole,  ///< probe and directional lights in one
    Rest,   ///< the probe less its key lights
};

/// A frame's light as gratings take it; what is derived is kept until the light changes.
class SurfaceLight {
 public:
    /// `window` tames the ringing of band-limited light; nothing stands for the mildest one that does.
    explicit SurfaceLight(std::optional<math::SphericalWindow> window);

    void set(const render::FrameLight& light);
    std::uint64_t version() const { return light_.version; }

    /// The light in so many bands, windowed.
    const lighting::ShLight& harmonics(int bands, LightShare share);
    /// LightShare::Rest at full resolution; null if the probe has no texels.
    const std::shared_ptr<const lighting::LightTexels>& texels() const { return light_.texels; }

    /// The key lights' uniform block.
    void bind_key_lights() const;

 private:
    std::optional<math::SphericalWindow> window_;
    render::FrameLight light_;
    std::map<std::pair<int, LightShare>, lighting::ShLight> windowed_;
    gpu::Buffer key_lights_;
};

}  // namespace rowland::diffraction
