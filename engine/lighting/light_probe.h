#pragma once

#include <cstddef>
#include <cstdint>
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

struct LightProbeSettings {
    int bands = 16;       ///< of the raw SH, 1 to 32; modules take what they need of them
    int key_lights = 16;  ///< at most so many lobes for its bright parts, 0 to kMaximumKeyLights
    int light_face =
        256;  ///< of the cube that the full-resolution light is stored in; as fine as a probe of 1024 × 512
    PrefilterSettings prefilter;
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of the probe's white
};

/// The cooked probe: one source for the engine's ambient and reflections and for every module's lighting.
struct LightProbe {
    ShLight sh;                                     ///< raw radiance
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of its white
    AmbientLight ambient;                           ///< derived from sh, never stored
    std::vector<KeyLight> key_lights;  ///< brightest first. What they leave is derived: residual(), unpack()
    PackedLight light;                 ///< all of it, the key lights' too, at full resolution
    PackedEnvironmentMap environment;  ///< prefiltered for glossy reflection
    TexelReport report;                ///< what the source image held that was not light
};

/// Version of serialise()'s layout and of what build_light_probe() computes; part of the cooked header.
inline constexpr std::uint32_t kLightProbeVersion = 3;

/// Deterministic for any number of threads.
LightProbe build_light_probe(const ProbeImage& probe, const LightProbeSettings& settings = {});

std::vector<std::byte> serialise(const LightProbe& probe);

/// Inverse of serialise() for bytes that may be hostile; recomputes what is derived. Throws Error (input) naming `file`
/// and the byte.
LightProbe deserialise(std::span<const std::byte> bytes, const std::string& file);

/// "name: value" lines.
std::string describe(const LightProbe& probe);

}  // namespace rowland::lighting
