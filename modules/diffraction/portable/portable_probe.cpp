#include "modules/diffraction/portable/portable_probe.h"

#include <array>

#include "modules/diffraction/representations/planar/planar_map.h"

namespace rowland::diffraction {

namespace {

std::vector<float> floats_of(std::span<const glm::dvec3> vectors) {
    std::vector<float> numbers;
    for (const glm::dvec3& vector : vectors)
        for (int i = 0; i < 3; ++i) numbers.push_back(static_cast<float>(vector[i]));
    return numbers;
}

std::vector<float> floats_of(std::span<const glm::vec3> vectors) {
    std::vector<float> numbers;
    for (const glm::vec3& vector : vectors) numbers.insert(numbers.end(), {vector.x, vector.y, vector.z});
    return numbers;
}

}  // namespace

void add_probe(const EvaluationLight& light, int bands, PortableDocument& document) {
    const lighting::ShLight rest = light.harmonics(bands);
    const std::array<std::size_t, 2> shape{rest.coefficients.size(), 3};
    nlohmann::json keys = nlohmann::json::array();
    for (const lighting::KeyLight& key : light.key_lights())
        keys.push_back(
            {{"direction", to_json(key.direction)}, {"flux", to_json(key.flux)}, {"concentration", key.concentration}});
    document.json["probe"] = {{"key_lights", std::move(keys)},
                              {"bands", bands},
                              {"rest_sh", append_array(floats_of(rest.coefficients), shape, document.bytes)}};
}

void add_planar_map(const CookedMaterial& cooked, const EvaluationLight& light, const glm::dvec3& normal,
                    const PlanarMapSize& size, PortableDocument& document) {
    const Grating& grating = cooked.material.grating;
    const PlanarMap map = fill_planar_map(light.texels(), cooked.kernel, grating.pitch_nm, normal, size,
                                          cooked.zero_order_xyz, grating.cover);
    const std::array<std::size_t, 3> shape{static_cast<std::size_t>(map.views), static_cast<std::size_t>(map.azimuths),
                                           3};
    document.json["planar"] = {{"e1", to_json(map.e1)},
                               {"e2", to_json(map.e2)},
                               {"normal", to_json(map.n)},
                               {"xyz", append_array(floats_of(map.xyz), shape, document.bytes)}};
}

}  // namespace rowland::diffraction
