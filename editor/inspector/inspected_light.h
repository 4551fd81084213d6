#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "engine/lighting/light_probe.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/representations/evaluation_light.h"

namespace rowland::inspector {

/// A probe as the preview and the panes need it.
struct InspectedLight {
    std::filesystem::path path;
    lighting::ProbeImage image;            ///< at full resolution, for the reference
    lighting::LightProbe probe;            ///< as the demo loads it
    int key_lights = 0;                    ///< the largest number of key lights
    diffraction::EvaluationLight divided;  ///< into key lights and the rest
};

/// Loads a probe recipe (.json) or an image (.hdr, .exr; `mapping` "equirect" or "angular"). Runs on any thread; takes
/// seconds. Throws Error (input).
std::shared_ptr<const InspectedLight> load_light(const std::filesystem::path& path, const std::string& mapping);

}  // namespace rowland::inspector
