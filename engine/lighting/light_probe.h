#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/lighting/ambient.h"
#include "engine/lighting/environment_map.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/packed_light.h"
#include "engine/lighting/prefilter.h"
#include "engine/lighting/probe_image.h"
#include "engine/lighting/sh_light.h"

namespace rowland::lighting {

/// The room that a capture is shown as: a floor, and a sphere about the camera that took it.
struct CaptureDome {
    double height_m = 1.6;  ///< of that camera above the floor
    double radius_m = 0.0;  ///< of the sphere, larger than the height
};
inline constexpr double kLargestDome_m = 1e5;

struct LightProbeSettings {
    int bands = 16;       ///< of the raw SH, 1 to 32
    int key_lights = 16;  ///< at most, 0 to kMaximumKeyLights
    KeyLightFit key_light_fit = {};
    int light_face = 256;  ///< cells a side of the packed light; about the texels of a probe of 1024 × 512
    PrefilterSettings prefilter;
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of the probe's white
    std::optional<CaptureDome> dome = {};
};

/// The cooked probe: the engine's ambient light and reflections and every module's lighting come from it.
struct LightProbe {
    ShLight sh;                                     ///< raw radiance
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of its white
    AmbientLight ambient;                           ///< derived from sh, never stored
    std::vector<KeyLight> key_lights;  ///< in fit_key_lights()' order. residual(), unpack() are without them
    PackedLight light;                 ///< at full resolution, with the key lights
    PackedEnvironmentMap environment;  ///< prefiltered for glossy reflection
    std::optional<CaptureDome> dome;   ///< none: what is seen of it is infinitely far away
    TexelReport report;                ///< texels of the source image that were taken as black
};

/// Version of serialise()'s layout and of build_light_probe()'s results; part of the cooked header.
inline constexpr std::uint32_t kLightProbeVersion = 5;

/// Deterministic for any number of threads.
LightProbe build_light_probe(const ProbeImage& probe, const LightProbeSettings& settings = {});

std::vector<std::byte> serialise(const LightProbe& probe);

/// Inverse of serialise() for bytes that may be hostile; computes `ambient` again. Throws Error (input) naming `file`
/// and the byte.
LightProbe deserialise(std::span<const std::byte> bytes, const std::string& file);

/// "name: value" lines.
std::string describe(const LightProbe& probe);

}  // namespace rowland::lighting
