#pragma once

#include <filesystem>
#include <string>

#include "engine/lighting/probe_image.h"

namespace rowland::demo {

/// A probe at full resolution, as the reference takes it.
struct WholeProbe {
    lighting::ProbeImage image;
    int key_lights = 16;  ///< most that it is cooked with
};

/// The image that a probe was made from: an image file (`mapping` "equirect" or "angular"), or a recipe's. A cooked
/// probe is looked for as the recipe of its name in `recipes`. Throws Error (input), also where there is none.
WholeProbe load_whole_probe(const std::filesystem::path& path, const std::string& mapping,
                            const std::filesystem::path& recipes);

}  // namespace rowland::demo
