// Key lights of a probe, in a module of their own: a picture without them comes first.
#include <cstdlib>

#include "content/web/bake/exports.h"
#include "content/web/bake/material.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/probe_image.h"

namespace rowland::web {

/// Key lights of an image, kKeyLightNumbers each. `texels`: as of read_probe(). Takes about a second.
ROWLAND_EXPORT(fit_key_lights)
Numbers* fit_key_lights(glm::vec3* texels, int width, int height, int count) {
    image::Image image{width, height, std::vector<glm::vec3>(texels, texels + width * height)};
    std::free(texels);
    const lighting::ProbeImage probe(std::move(image), lighting::Mapping::Equirectangular);
    auto* numbers = new Numbers;
    for (const lighting::KeyLight& key : lighting::fit_key_lights(probe, count)) {
        append(glm::vec3(key.direction), *numbers);
        append(glm::vec3(key.flux), *numbers);
        append(static_cast<float>(key.concentration), *numbers);
    }
    return numbers;
}

}  // namespace rowland::web
