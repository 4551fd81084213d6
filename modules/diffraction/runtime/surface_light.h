#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/lighting/light_samples.h"
#include "engine/lighting/sh_light.h"
#include "engine/math/spherical_harmonics.h"
#include "engine/render/material.h"
#include "modules/diffraction/shaders/light_blocks.h"

namespace rowland::diffraction {

/// Ringing of a grating under this band-limited light: the negative fraction of the light that half circles around the
/// grating vector gather (flat lobe), averaged over a fixed set of tangent frames. In [0, 1].
double ringing(const lighting::ShLight& light);

/// Ringing up to this does not show as dark patches on a disc, judged on images under captured and synthetic probes.
/// Captures of indoor and outdoor light have 0 … 0.03, a single lamp in a dark room 0.27, with Lanczos 0.02.
inline constexpr double kTolerableRinging = 0.03;

/// The weakest of none, Lanczos and Hann under which the light in `bands` bands rings tolerably; Hann if none does.
math::SphericalWindow weakest_window(const lighting::ShLight& light, int bands);

/// Adds distant lights to raw radiance: L(s) = E δ(s − d), so l_i += E Y_i(d).
void add_distant_lights(std::span<const render::DistantLight> lights, lighting::ShLight& sh);

/// A frame's light as gratings read it: windowed harmonics, samples and GPU resources, each derived when it is first
/// read and kept until the light changes. Linear Rec.709, world axes.
class SurfaceLight {
 public:
    /// `window`: against the ringing of band-limited light; nullopt: the weakest sufficient one.
    explicit SurfaceLight(std::optional<math::SphericalWindow> window) : window_(window) {}

    /// The frame's probe must not be null.
    void set(const render::FrameLight& frame);
    /// Another pointer with each change of the light, and never one of another SurfaceLight's: versions are counted by
    /// each renderer from the same number.
    const std::shared_ptr<const std::uint64_t>& version() const { return version_; }
    /// Name of the spectrum of the probe's white.
    const std::string& illuminant() const { return frame_.probe->illuminant.name; }

    /// The probe and the directional lights in this number of bands, windowed.
    const lighting::ShLight& whole_harmonics(int bands);
    /// The probe without key_lights(key_light_limit), in this number of bands, windowed.
    const lighting::ShLight& probe_harmonics(int bands, int key_light_limit);
    /// The same light at full resolution; null if the probe has no samples.
    const std::shared_ptr<const lighting::LightSamples>& probe_samples(int key_light_limit) const;

    /// The probe's first `most` key lights, or all; none unless the frame shades them as analytic lights.
    std::span<const lighting::KeyLight> key_lights(int most) const;
    /// Distinct colours of the engine's lights[], linear Rec.709, the largest component 1.
    std::span<const glm::vec3> light_colours() const { return light_colours_; }
    /// The colours' uniform block and that of key_lights(most): light_blocks.h.
    void bind_light_colours() const;
    void bind_key_lights(int most) const;

 private:
    void set_light_colours(std::span<const glm::vec3> strengths);
    lighting::ShLight windowed(const lighting::ShLight& light, int bands) const;

    std::optional<math::SphericalWindow> window_;
    render::FrameLight frame_;
    std::shared_ptr<const std::uint64_t> version_;
    std::vector<glm::vec3> light_colours_;
    LightColourBlock colour_block_ = {};
    mutable gpu::StreamBuffer colour_buffer_;
    mutable bool colours_changed_ = true;     ///< since they were bound
    std::map<int, lighting::ShLight> whole_;  ///< by bands
    /// By bands and number of key lights.
    std::map<std::pair<int, std::size_t>, lighting::ShLight> without_key_lights_;
    /// By number of key lights.
    mutable std::map<std::size_t, std::shared_ptr<const lighting::LightSamples>> samples_;
    struct KeyLightBuffer {
        gpu::StreamBuffer buffer;
        bool changed = true;  ///< since it was bound
    };
    mutable std::map<std::size_t, KeyLightBuffer> key_lights_;  ///< by their number
};

}  // namespace rowland::diffraction
