#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/lighting/environment_map.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_samples.h"
#include "engine/lighting/probe_image.h"
#include "engine/lighting/sh_light.h"
#include "engine/math/spherical_harmonics.h"

namespace rowland::lighting {

/// Band factors that keep irradiance non-negative.
struct AmbientWindow {
    math::SphericalWindow window = math::SphericalWindow::None;
    double damping = 0;  ///< if > 0: exp(−damping·l(l+1)) in place of `window`
};

/// 9 SH coefficients of E(n)/π, the radiance that a white diffuse surface of normal n reflects. Linear Rec.709 RGB,
/// world axes, index l(l+1)+m.
struct AmbientLight {
    std::array<glm::dvec3, 9> coefficients = {};
    AmbientWindow window;
};

/// The first three bands convolved with the clamped cosine, under the weakest window (none, Lanczos or Hann over three
/// bands, then exponentials of increasing damping) that keeps E non-negative in a dense set of directions. Missing
/// bands count as zeros. `keys`: lobes whose irradiance is added to that of `light`. Only the sum must be
/// non-negative: `light` may be a residual().
AmbientLight ambient_coefficients(const ShLight& light, std::span<const KeyLight> keys = {});

/// The room that a capture is drawn in: a floor, and a sphere about the camera that took it.
struct CaptureDome {
    double height_m = 1.6;  ///< of that camera above the floor
    double radius_m = 0.0;  ///< of the sphere, larger than the height
};
inline constexpr double kLargestDome_m = 1e5;

struct LightProbeSettings {
    int bands = 16;       ///< of the raw SH, 1 to 32
    int key_lights = 16;  ///< at most, 0 to kMaximumKeyLights
    KeyLightFit key_light_fit = {};
    int light_face = 256;  ///< cells per face side of the packed light; about the texels of a probe of 1024 × 512
    PrefilterSettings prefilter;
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of the probe's white
    std::optional<CaptureDome> dome = {};
};

/// The cooked probe: the engine's ambient light and reflections and every module's lighting come from it.
struct LightProbe {
    ShLight sh;                                     ///< raw radiance
    colour::Illuminant illuminant = colour::d65();  ///< the spectrum of its white
    AmbientLight ambient;                           ///< derived from sh, never stored
    std::vector<KeyLight> key_lights;               ///< sorted by importance; residual() and unpack() subtract them
    PackedLight light;                              ///< at full resolution, with the key lights
    PackedEnvironmentMap environment;               ///< prefiltered for glossy reflection
    std::optional<CaptureDome> dome;                ///< none: the environment is infinitely far away
    InvalidTexelCounts report;                      ///< of the source image
};

/// Version of serialise()'s layout and of build_light_probe()'s results; part of the cooked header.
inline constexpr std::uint32_t kLightProbeVersion = 5;

/// The largest component of a texel of which build_light_probe() makes a probe.
inline constexpr float kLargestRadiance = 1e30F;

/// Deterministic for any number of threads. Throws Error (input) if the image is brighter than kLargestRadiance.
LightProbe build_light_probe(const ProbeImage& probe, const LightProbeSettings& settings = {});

std::vector<std::byte> serialise(const LightProbe& probe);

/// Inverse of serialise() for bytes that may be hostile; computes `ambient` again. Throws Error (input) naming `file`
/// and the byte.
LightProbe deserialise(std::span<const std::byte> bytes, const std::string& file);

/// "name: value" lines.
std::string describe(const LightProbe& probe);

}  // namespace rowland::lighting
