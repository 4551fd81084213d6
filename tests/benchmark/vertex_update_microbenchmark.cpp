// The processor time for an object of 25 000 vertices in a frame after it has turned: the paper's steps 1 and 2 without
// the upload, for each representation that needs them.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <variant>

#include "engine/math/sh_basis.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/representations/arc/arc_products.h"
#include "modules/diffraction/runtime/tangent_light.h"
#include "tests/benchmark/cd_materials.h"
#include "tests/benchmark/microbenchmarks.h"

namespace rowland::microbenchmark {

namespace {

using ::benchmark::State;

constexpr int kUpdateBands = 5;

lighting::ShLight some_light() {
    lighting::ShLight light;
    light.bands = kUpdateBands;
    for (int i = 0; i < math::sh_count(kUpdateBands); ++i)
        light.coefficients.emplace_back(std::cos(i), std::cos(2 * i), std::cos(3 * i));
    return light;
}

/// Calls update(light, mesh, object to world) for an object that turns.
template <typename Update>
void turn(State& state, const Update& update) {
    const scene::Mesh disc = scene::build_mesh(scene::DiscRecipe{.inner_radius = 0.0235, .outer_radius = 0.058});
    const lighting::ShLight light = some_light();
    float angle = 0.0F;
    for (auto _ : state) {
        angle += 0.01F;
        const glm::mat4 matrix = glm::rotate(glm::mat4(1.0F), angle, glm::vec3(1.0F, 0.0F, 0.0F));
        ::benchmark::DoNotOptimize(update(light, disc, matrix).data());
    }
    report_each(state, disc.positions.size());
}

/// Spikes, bins and transfer: 25 coefficients per vertex and colour.
void rotate_light(State& state) {
    turn(state, [](const lighting::ShLight& light, const scene::Mesh& mesh, const glm::mat4& matrix) {
        return diffraction::rotate_to_vertices(light, mesh, matrix);
    });
}

void arc_products(State& state) {
    const diffraction::CookedMaterial cooked = diffraction::cook_material(
        rowland::benchmark::cd_material({{"representation", "arc"}, {"bands", kUpdateBands}, {"rank", 8}}), "the CD");
    const diffraction::ArcProducts products(std::get<diffraction::ArcTable>(cooked.tables), glm::dmat3(1.0));
    turn(state, [&](const lighting::ShLight& light, const scene::Mesh& mesh, const glm::mat4& matrix) {
        return products(light, mesh, matrix, 0.0);
    });
}

}  // namespace

void register_vertex_updates() {
    ::benchmark::RegisterBenchmark("vertex_update/spikes/bands:5", rotate_light)
        ->Unit(::benchmark::kMillisecond)
        ->UseRealTime();
    ::benchmark::RegisterBenchmark("vertex_update/arc/bands:5/rank:8", arc_products)
        ->Unit(::benchmark::kMillisecond)
        ->UseRealTime();
}

}  // namespace rowland::microbenchmark
