#include "tests/gpu/modules/diffraction/grating_light.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/image/image.h"
#include "engine/lighting/environment_map.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/light_samples.h"

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

GratingLight light_of(const lighting::ProbeImage& image, std::vector<lighting::KeyLight> keys, std::uint64_t version) {
    constexpr int kBands = 10;
    constexpr int kLightFace = 32;
    GratingLight light{.key_lights = std::move(keys), .residual = lighting::project(image, kBands), .version = version};
    light.sh = light.residual;
    lighting::LightProbe probe;
    if (!light.key_lights.empty()) {
        const lighting::ShLight lobes = lighting::project(light.key_lights, kBands);
        for (std::size_t i = 0; i < light.sh.coefficients.size(); ++i)
            light.sh.coefficients[i] += lobes.coefficients[i];
        light.residual = lighting::residual(light.sh, light.key_lights, kBands);
    }
    std::vector<lighting::KeyLight> removed = light.key_lights;  // removing negative light adds it
    for (lighting::KeyLight& key : removed) key.flux = -key.flux;
    probe.sh = light.sh;
    probe.key_lights = light.key_lights;
    probe.light = lighting::pack(lighting::light_samples(image, removed, 0.1), kLightFace);
    light.probe_texels = std::make_shared<const lighting::LightSamples>(lighting::unpack(probe.light));
    light.texels = std::make_shared<const lighting::LightSamples>(lighting::unpack(probe.light, light.key_lights));
    light.probe = std::make_shared<const lighting::LightProbe>(std::move(probe));
    return light;
}

GratingLight black_light() {
    lighting::LightProbe probe;
    probe.sh = {.bands = 10, .coefficients = std::vector<glm::dvec3>(100, glm::dvec3(0.0))};
    GratingLight light{.sh = probe.sh, .residual = probe.sh, .version = 1};
    light.probe = std::make_shared<const lighting::LightProbe>(std::move(probe));
    return light;
}

}  // namespace rowland::diffraction
