#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "engine/gpu/buffer.h"
#include "engine/lighting/sh_light.h"
#include "engine/math/sh_window.h"
#include "engine/render/material.h"
#include "modules/diffraction/runtime/radiance_cube.h"

namespace rowland::diffraction {

/// Which part of a frame's light.
enum class LightShare {
    Whole,  ///< probe and directional lights in one
    Probe,  ///< the probe alone
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
    /// The probe, or LightShare::Rest of it, at full resolution; null if the probe has no texels.
    const std::shared_ptr<const lighting::LightTexels>& texels(LightShare share) const {
        return share == LightShare::Rest ? light_.texels : light_.probe_texels;
    }

    /// The whole probe on the GPU: made when first asked for, and anew for another probe. Black if the light has none.
    std::shared_ptr<const RadianceCube> radiance();

    /// How many cubes were made.
    int radiance_uploads() const { return radiance_uploads_; }

    /// As many as the uniform block holds.
    std::span<const lighting::KeyLight> key_lights() const;
    /// See render::FrameLight.
    std::span<const glm::vec3> light_colours() const { return light_.light_colours; }
    /// The key lights' uniform block.
    void bind_key_lights() const;

 private:
    std::optional<math::SphericalWindow> window_;
    render::FrameLight light_;
    bool lit_ = false;  ///< light_ was set
    std::map<std::pair<int, LightShare>, lighting::ShLight> windowed_;
    mutable gpu::Buffer key_lights_;  ///< made when first bound
    std::shared_ptr<const lighting::PackedEnvironmentMap> cube_of_;
    std::shared_ptr<const RadianceCube> cube_;
    int radiance_uploads_ = 0;
};

}  // namespace rowland::diffraction
