#pragma once

#include <filesystem>
#include <string>

#include "engine/lighting/probe_image.h"

namespace rowland::demo {

/// A probe at full resolution, for the reference.
struct WholeProbe {
    lighting::ProbeImage image;
    int key_lights = 16;  ///< the most that it is cooked with
};

/// The image of a probe: an image file (`mapping` "equirect" or "angular"), or that of a recipe. For a cooked probe,
/// the recipe of its name in `recipes`, or in the folder "recipes" beside it. Throws Error (input), also if there is none.
WholeProbe load_whole_probe(const std::filesystem::path& path, const std::string& mapping,
                            const std::filesystem::path& recipes);

}  // namespace rowland::demo
