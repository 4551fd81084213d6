#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "engine/lighting/light_probe.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/representations/evaluation_light.h"

namespace rowland::inspector {

/// A probe in the forms that the preview and the panes take.
struct InspectedLight {
    std::filesystem::path path;
    lighting::ProbeImage image;  ///< at full resolution: what the reference integrates
    lighting::LightProbe probe;  ///< as the demo loads it
    int key_lights = 0;          ///< at most, that are taken out of it
    diffraction::EvaluationLight divided;
};

/// Loads a probe recipe (.json) or an image (.hdr, .exr; `mapping` "equirect" or "angular"). Runs on any thread; takes
/// seconds. Throws Error (input).
std::shared_ptr<const InspectedLight> load_light(const std::filesystem::path& path, const std::string& mapping);

}  // namespace rowland::inspector
