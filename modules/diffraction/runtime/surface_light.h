#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "engine/gpu/stream_buffer.h"
#include "engine/lighting/sh_light.h"
#include "engine/math/sh_window.h"
#include "modules/diffraction/runtime/light_parts.h"
#include "modules/diffraction/shaders/light_colour_block.h"

namespace rowland::diffraction {

/// Which part of a frame's light.
enum class LightPart {
    Whole,  ///< the probe and the directional lights
    Probe,  ///< the probe alone
    Rest,   ///< the probe without its key lights
};

/// A frame's light as gratings read it: windowed harmonics and GPU resources, cached until the light changes.
class SurfaceLight {
 public:
    /// `window`: against the ringing of band-limited light; nullopt: the weakest sufficient one.
    explicit SurfaceLight(std::optional<math::SphericalWindow> window);

    void set(const LightParts& light);
    std::uint64_t version() const { return light_.version; }

    /// The light in this number of bands, windowed.
    const lighting::ShLight& harmonics(int bands, LightPart part);
    /// The probe, or LightPart::Rest of it, at full resolution; null if the probe has no texels.
    const std::shared_ptr<const lighting::LightSamples>& texels(LightPart part) const {
        return part == LightPart::Rest ? light_.texels : light_.probe_texels;
    }

    /// The first ROWLAND_MAXIMUM_KEY_LOBES.
    std::span<const lighting::KeyLight> key_lights() const;
    /// Distinct colours of the engine's lights[], linear Rec.709, the largest component 1.
    std::span<const glm::vec3> light_colours() const { return light_colours_; }
    /// The colours' uniform block (light_colour_block.h) and the key lights' (key_lobe_block.h).
    void bind_light_colours() const;
    void bind_key_lights() const;

 private:
    std::optional<math::SphericalWindow> window_;
    void set_light_colours(std::span<const glm::vec3> strengths);

    LightParts light_;
    bool lit_ = false;  ///< light_ was set
    std::vector<glm::vec3> light_colours_;
    LightColourBlock colour_block_ = {};
    mutable gpu::StreamBuffer colour_buffer_;
    mutable bool colours_changed_ = true;  ///< since they were bound
    std::map<std::pair<int, LightPart>, lighting::ShLight> windowed_;
    mutable gpu::StreamBuffer key_lights_;
    mutable bool key_lights_changed_ = true;  ///< since they were bound
};

}  // namespace rowland::diffraction
