// The representation arc: curved surfaces under light in spherical harmonics.
#include <cstdlib>
#include <glm/glm.hpp>

#include "content/web/bake/exports.h"
#include "content/web/bake/material.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/probe_image.h"
#include "engine/lighting/sh_light.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/runtime/vertex_light.h"

namespace rowland::web {

/// A table, and what vertices take from it.
struct Arc {
    diffraction::ArcTable table;
    diffraction::ArcProducts products;
};

/// `pitches`: number of nodes from `smallest` to `largest` times the material's pitch, or 1: its pitch alone.
ROWLAND_EXPORT(bake_arc)
Arc* bake_arc(const Material* material, int bands, int rank, double smallest, double largest, int pitches) {
    using namespace diffraction;
    ArcSettings settings{.bands = bands,
                         .rank = rank,
                         .storage = Storage::Float,
                         .illuminant = material->source.material.quality.illuminant};
    if (pitches > 1) settings.pitch = PitchAxis{.smallest = smallest, .largest = largest, .nodes = pitches};
    ArcTable table = bake(material->grating(), settings);
    ArcProducts products(table, xyz_to_working());
    return new Arc{.table = std::move(table), .products = std::move(products)};
}

ROWLAND_EXPORT(release_arc) void release_arc(const Arc* arc) {
    delete arc;
}

/// Mapping of views, columns, rows, layers, scale and bias of the pitch; then the weights, RGBA, layer by layer.
ROWLAND_EXPORT(arc_weights) Numbers* arc_weights(const Arc* arc) {
    const diffraction::ArcTable& table = arc->table;
    const std::size_t layers = diffraction::weight_layers(table.rank);
    auto* numbers = new Numbers;
    append(glm::vec4(static_cast<int>(table.grid.mapping), table.grid.columns, table.rows(), layers), *numbers);
    append(table.pitch ? glm::vec2(table.pitch->scale_bias()) : glm::vec2(0.0F), *numbers);
    const std::size_t texels = static_cast<std::size_t>(table.grid.columns) * static_cast<std::size_t>(table.rows());
    for (std::size_t texel = 0; texel < layers * texels; ++texel)
        for (std::size_t component = 0; component < diffraction::kTexelComponents; ++component)
            append(static_cast<float>(table.value(texel / texels, texel, component)), *numbers);
    return numbers;
}

/// Raw SH of a probe's light without its key lights. `texels`: linear Rec.709, row 0 at the top; released here. `keys`:
/// those of fit_key_lights() in keys.cpp, `count` of them.
ROWLAND_EXPORT(rest_sh)
Numbers* rest_sh(glm::vec3* texels, int width, int height, const float* keys, int count, int bands) {
    image::Image image{width, height, std::vector<glm::vec3>(texels, texels + width * height)};
    std::free(texels);
    const std::vector<lighting::KeyLight> lights = key_lights_of(keys, count);
    const lighting::ShLight probe =
        lighting::project(lighting::ProbeImage(std::move(image), lighting::Mapping::Equirectangular), bands);
    auto* numbers = new Numbers;
    for (const glm::dvec3& coefficient : lighting::residual(probe, lights, bands).coefficients)
        append(glm::vec3(coefficient), *numbers);
    return numbers;
}

/// The products of vertices: 3 · layers vec4s each. `sh`: of rest_sh(), in the table's bands. `normals` and
/// `gratings`: of `vertices` vertices in the world.
ROWLAND_EXPORT(arc_products)
Numbers* arc_products(const Arc* arc, const float* sh, const float* normals, const float* gratings, int vertices) {
    lighting::ShLight light{.bands = arc->table.bands, .coefficients = {}};
    for (int i = 0; i < light.bands * light.bands; ++i)
        light.coefficients.emplace_back(sh[3 * i], sh[3 * i + 1], sh[3 * i + 2]);
    scene::Mesh frames;
    for (int i = 0; i < vertices; ++i) {
        frames.normals.emplace_back(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
        frames.tangents.emplace_back(gratings[3 * i], gratings[3 * i + 1], gratings[3 * i + 2], 1.0F);
    }
    auto* numbers = new Numbers;
    for (const glm::vec4& product : arc->products(light, frames, glm::mat4(1.0F), 0.0)) append(product, *numbers);
    return numbers;
}

}  // namespace rowland::web
