#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>

#include "engine/gpu/stream_buffer.h"
#include "engine/lighting/sh_light.h"
#include "engine/math/sh_window.h"
#include "modules/diffraction/runtime/light_parts.h"
#include "modules/diffraction/shaders/light_colour_block.h"

namespace rowland::diffraction {

/// Which part of a frame's light.
struct LightPart {
    enum Kind {
        Whole,  ///< the probe and the directional lights
        Probe,  ///< the probe alone
        Rest,   ///< the probe without its first `key_lights` key lights
    };
    Kind kind;
    int key_lights = 0;

    constexpr LightPart(Kind part, int keys = 0) : kind(part), key_lights(keys) {}
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
    const std::shared_ptr<const lighting::LightSamples>& texels(LightPart part) const;

    /// The first so many, or all.
    std::span<const lighting::KeyLight> key_lights(int most) const;
    /// Distinct colours of the engine's lights[], linear Rec.709, the largest component 1.
    std::span<const glm::vec3> light_colours() const { return light_colours_; }
    /// The colours' uniform block (light_colour_block.h) and that of key_lights(most) (key_lobe_block.h).
    void bind_light_colours() const;
    void bind_key_lights(int most) const;

 private:
    std::optional<math::SphericalWindow> window_;
    void set_light_colours(std::span<const glm::vec3> strengths);

    LightParts light_;
    bool lit_ = false;  ///< light_ was set
    std::vector<glm::vec3> light_colours_;
    LightColourBlock colour_block_ = {};
    mutable gpu::StreamBuffer colour_buffer_;
    mutable bool colours_changed_ = true;  ///< since they were bound
    /// By bands, part and number of key lights.
    std::map<std::tuple<int, LightPart::Kind, std::size_t>, lighting::ShLight> windowed_;
    /// Without so many key lights.
    mutable std::map<std::size_t, std::shared_ptr<const lighting::LightSamples>> texels_;
    struct KeyLightBuffer {
        gpu::StreamBuffer buffer;
        bool changed = true;  ///< since it was bound
    };
    mutable std::map<std::size_t, KeyLightBuffer> key_lights_;  ///< by their number
};

}  // namespace rowland::diffraction
