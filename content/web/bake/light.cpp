// A probe, and what a material's flat surfaces show of it.
#include <cstdlib>

#include "content/web/bake/exports.h"
#include "content/web/bake/material.h"
#include "engine/lighting/light_samples.h"
#include "modules/diffraction/bake/diffraction_pattern.h"
#include "modules/diffraction/representations/planar/lobe_map.h"
#include "modules/diffraction/representations/planar/planar_map.h"
#include "modules/diffraction/runtime/key_lobe.h"

namespace rowland::web {

/// A probe, its key lights once they are fitted, and its light samples without these.
struct Probe {
    lighting::ProbeImage image;
    std::vector<lighting::KeyLight> keys;
    lighting::LightSamples light;
};

/// `texels`: linear Rec.709, row 0 at the top; released here.
ROWLAND_EXPORT(read_probe) Probe* read_probe(glm::vec3* texels, int width, int height) {
    image::Image image{width, height, std::vector<glm::vec3>(texels, texels + width * height)};
    std::free(texels);
    auto* probe = new Probe{.image = {std::move(image), lighting::Mapping::Equirectangular}, .keys = {}, .light = {}};
    probe->light = lighting::light_samples(probe->image, probe->keys);
    return probe;
}

/// Takes lights of fit_key_lights() out of the probe.
ROWLAND_EXPORT(use_key_lights) void use_key_lights(Probe* probe, const float* keys, int count) {
    probe->keys = key_lights_of(keys, count);
    probe->light = lighting::light_samples(probe->image, probe->keys);
}

ROWLAND_EXPORT(release_probe) void release_probe(const Probe* probe) {
    delete probe;
}

/// Width and height of the probe's image, then its texels, RGB.
ROWLAND_EXPORT(probe_texels) Numbers* probe_texels(const Probe* probe) {
    auto* numbers =
        new Numbers{static_cast<float>(probe->image.image().width), static_cast<float>(probe->image.image().height)};
    for (const glm::vec3& texel : probe->image.image().texels) append(texel, *numbers);
    return numbers;
}

/// KeyLobe for each light: shaders/light_blocks.h.
ROWLAND_EXPORT(key_lobes) Numbers* key_lobes(const Probe* probe) {
    auto* numbers = new Numbers;
    for (const lighting::KeyLight& key : probe->keys) append(diffraction::key_lobe(key), *numbers);
    return numbers;
}

/// The `planar` map of the flat lobe: e1, e2, scale and bias of the pitch, then RGB over azimuths, views and pitches.
/// `x`, `y`, `z`: the normal. `resolution`: views, even; azimuths are twice as many. `pitches`: number of nodes from
/// `smallest` to `largest` times the material's pitch, or 1: its pitch alone.
ROWLAND_EXPORT(planar_map)
Numbers* planar_map(const Material* material, const Probe* probe, double x, double y, double z, int resolution,
                    double smallest, double largest, int pitches) {
    diffraction::PlanarMapSize size = diffraction::planar_map_size(resolution);
    if (pitches > 1) size.pitch = diffraction::PitchAxis{.smallest = smallest, .largest = largest, .nodes = pitches};
    const diffraction::PlanarMap map = diffraction::fill_planar_map(
        probe->light, in_space(material->kernel, xyz_to_working()), material->grating().pitch_nm, glm::dvec3(x, y, z),
        size, xyz_to_working() * material->zero_order_xyz, material->grating().cover);
    auto* numbers = new Numbers;
    append(glm::vec3(map.e1), *numbers);
    append(glm::vec3(map.e2), *numbers);
    append(map.pitch ? glm::vec2(map.pitch->scale_bias()) : glm::vec2(0.0F), *numbers);
    for (const glm::vec3& value : map.xyz) append(value, *numbers);
    return numbers;
}

/// The `planar` map of other lobes: e1, e2, lobe_map_axes, width, height, depth, whether its azimuths span only half a
/// turn; then RGB.
ROWLAND_EXPORT(lobe_map)
Numbers* lobe_map(const Material* material, const Probe* probe, double x, double y, double z, int azimuths, int views_g,
                  int views_h) {
    using namespace diffraction;
    const DiffractionPattern pattern =
        diffraction_pattern(material->grating(), colour::LightSpectra(material->source.material.quality.illuminant));
    const LobeMap map = in_space(
        fill_lobe_map(probe->light, LobeSpectrum(pattern, {.g = views_g, .h = views_h}), glm::dvec3(x, y, z), azimuths),
        xyz_to_working());
    const int depth = slices(map.size, map.half_turn);
    auto* numbers = new Numbers;
    append(glm::vec3(map.axes.e1), *numbers);
    append(glm::vec3(map.axes.e2), *numbers);
    append(glm::vec4(0.5 - 0.5 / views_g, 0.5 - 0.5 / views_h, static_cast<double>(azimuths) / depth, 0.5 / depth),
           *numbers);
    append(glm::vec4(views_g, views_h, depth, map.half_turn ? 1 : 0), *numbers);
    for (const glm::vec3& value : map.values) append(value, *numbers);
    return numbers;
}

}  // namespace rowland::web
