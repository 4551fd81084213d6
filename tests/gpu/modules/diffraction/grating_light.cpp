#include "tests/gpu/modules/diffraction/grating_light.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/image/image.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/light_samples.h"
#include "engine/lighting/prefilter.h"

namespace rowland::diffraction {

lighting::ProbeImage smooth_probe() {
    image::Image picture;
    picture.width = 64;
    picture.height = 32;
    for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < picture.width; ++column) {
            const double theta = std::numbers::pi * (row + 0.5) / picture.height;
            const double phi = 2.0 * std::numbers::pi * ((column + 0.5) / picture.width - 0.5);
            const glm::dvec3 s(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
            picture.texels.emplace_back(glm::vec3(1.0 + 0.6 * s.y + 0.3 * s.x * s.z, 0.8 + 0.5 * s.x * s.y - 0.2 * s.z,
                                                  0.7 + 0.4 * s.z + 0.3 * s.y * s.y));
        }
    return {std::move(picture), lighting::Mapping::Equirectangular};
}

std::vector<lighting::KeyLight> three_keys() {
    return {{.direction = glm::normalize(glm::dvec3(0.5, 0.3, 0.8)), .flux = {1.0, 0.8, 0.5}, .concentration = 300.0},
            {.direction = glm::normalize(glm::dvec3(-0.8, 0.5, 0.2)), .flux = {0.2, 0.5, 1.0}, .concentration = 60.0},
            {.direction = glm::normalize(glm::dvec3(0.1, -0.9, 0.15)), .flux = {0.9, 0.2, 0.1}, .concentration = 1e4}};
}

LightParts light_of(const lighting::ProbeImage& probe, std::vector<lighting::KeyLight> keys, std::uint64_t version) {
    constexpr int kBands = 10;
    LightParts light;
    light.residual = lighting::project(probe, kBands);
    light.sh = light.residual;
    const lighting::ShLight lobes = lighting::project(keys, kBands);
    for (std::size_t i = 0; i < light.sh.coefficients.size() && !keys.empty(); ++i)
        light.sh.coefficients[i] += lobes.coefficients[i];
    light.key_lights = std::move(keys);
    light.texels = std::make_shared<const lighting::LightSamples>(lighting::light_samples(probe, {}, 0.1));
    light.probe_sh = light.residual;
    light.probe_texels = light.texels;
    light.version = version;
    return light;
}

}  // namespace rowland::diffraction
