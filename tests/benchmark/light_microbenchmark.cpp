#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <variant>

#include "engine/core/parallel.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/probe_image.h"
#include "engine/lighting/procedural_probe.h"
#include "engine/lighting/sh_light.h"
#include "engine/math/spherical_harmonics.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/representations/circle/circle_map.h"
#include "modules/diffraction/representations/planar/lobe_map.h"
#include "modules/diffraction/representations/planar/planar_map.h"
#include "modules/diffraction/runtime/vertex_light.h"
#include "tests/benchmark/cd_materials.h"
#include "tests/benchmark/microbenchmarks.h"

// A light probe's image projected onto five bands.
// Key lights of a light probe's image.
// Filling the maps that depend on the light: at run time, when a flat object has turned or the probe has changed.
// The processor time for an object of 25 000 vertices in a frame after it has turned: the paper's steps 1 and 2 without
// the upload, for each representation that needs them.

namespace rowland::microbenchmark {

namespace {

void project_equirect(::benchmark::State& state, int width, unsigned threads) {
    const ThreadLimit limit(threads);
    image::Image image{width, width / 2, {}};
    for (int i = 0; i < image.width * image.height; ++i)
        image.texels.emplace_back(static_cast<float>(i % 97), static_cast<float>(i % 13), static_cast<float>(i % 29));
    const lighting::ProbeImage probe(std::move(image), lighting::Mapping::Equirectangular);
    for (auto _ : state) ::benchmark::DoNotOptimize(lighting::project(probe, 5).coefficients.data());
    report_each(state, 1);
}

}  // namespace

void register_projection() {
    for (const int width : {1024, 4096})
        for (const unsigned threads : {1U, 2U}) {
            const std::string name =
                "project_equirect/width:" + std::to_string(width) + "/bands:5/threads:" + std::to_string(threads);
            auto* benchmark = ::benchmark::RegisterBenchmark(name.c_str(), project_equirect, width, threads);
            benchmark->Unit(::benchmark::kMillisecond);
            if (threads > 1) benchmark->UseRealTime();
        }
}

namespace {

/// Lamps of all sizes, from one texel on, before a dim wall.
lighting::ProbeImage lamps(int width) {
    image::Image image = image::make_image(width, width / 2);
    for (int i = 0; i < image.width * image.height; ++i) image.texels[static_cast<std::size_t>(i)] = glm::vec3(0.1F);
    for (int lamp = 0; lamp < 64; ++lamp) {
        const int size = 1 + lamp % 16;
        const int column = lamp * 7919 % (width - size);
        const int row = lamp * 104729 % (width / 2 - size);
        for (int i = 0; i < size * size; ++i)
            image.at(column + i % size, row + i / size) = glm::vec3(static_cast<float>(1e4 / (1 + lamp)));
    }
    return {std::move(image), lighting::Mapping::Equirectangular};
}

void fit_key_lights(::benchmark::State& state, int width, int count, unsigned threads) {
    const ThreadLimit limit(threads);
    const lighting::ProbeImage probe = lamps(width);
    for (auto _ : state) ::benchmark::DoNotOptimize(lighting::fit_key_lights(probe, count).data());
    report_each(state, 1);
}

}  // namespace

void register_key_lights() {
    for (const int width : {1024, 4096})
        for (const int count : {16, 32}) {
            const std::string name =
                "fit_key_lights/width:" + std::to_string(width) + "/lights:" + std::to_string(count) + "/threads:2";
            ::benchmark::RegisterBenchmark(name.c_str(), fit_key_lights, width, count, 2U)
                ->Unit(::benchmark::kMillisecond)
                ->UseRealTime();
        }
}

namespace {

using ::benchmark::State;

constexpr int kProbeWidth = 1024;
constexpr int kLightFace = 256;  ///< of the cube that a cooked probe's light is stored in

/// Built on first use, outside the timed loops.
const lighting::LightSamples& studio_texels() {
    static const lighting::LightSamples texels = [] {
        const lighting::StudioRecipe room{.ceiling = glm::dvec3(0.02),
                                          .wall = glm::dvec3(0.035),
                                          .floor = glm::dvec3(0.02),
                                          .boxes = {{.azimuth_deg = 128,
                                                     .elevation_deg = 50,
                                                     .half_width_deg = 4,
                                                     .half_height_deg = 4,
                                                     .radiance = glm::dvec3(300)},
                                                    {.azimuth_deg = -65,
                                                     .elevation_deg = 25,
                                                     .half_width_deg = 8,
                                                     .half_height_deg = 24,
                                                     .radiance = glm::dvec3(1)}}};
        const lighting::ProbeImage picture(lighting::render_studio(room, kProbeWidth),
                                           lighting::Mapping::Equirectangular);
        return lighting::gather_texels(lighting::light_samples(picture), kLightFace);
    }();
    return texels;
}

const diffraction::CookedMaterial& cd() {
    static const diffraction::CookedMaterial cooked =
        diffraction::cook_material(rowland::benchmark::cd_material({{"representation", "direct"}}), "the CD");
    return cooked;
}

void fill_planar(State& state, int side) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, 0.9, 0.3));
    const lighting::LightSamples& texels = studio_texels();
    const diffraction::CookedMaterial& material = cd();
    for (auto _ : state)
        ::benchmark::DoNotOptimize(diffraction::fill_planar_map(texels, material.kernel,
                                                                material.material.grating.pitch_nm, normal,
                                                                {.azimuths = side, .views = side})
                                       .xyz.data());
}

/// A map of Stam's pits: what a thread fills after a tilt, first the coarse one.
void fill_lobe(State& state, const diffraction::LobeMapSize& size) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, 0.9, 0.3));
    const lighting::LightSamples& texels = studio_texels();
    diffraction::Grating grating = cd().material.grating;
    grating.lobe = diffraction::PitsLobe{};
    const diffraction::LobeSpectrum spectrum(diffraction::diffraction_pattern(grating, colour::LightSpectra()),
                                             size.views);
    for (auto _ : state)
        ::benchmark::DoNotOptimize(diffraction::fill_lobe_map(texels, spectrum, normal, size.azimuths).values.data());
}

void fill_circle(State& state, int side) {
    const lighting::LightSamples& texels = studio_texels();
    const diffraction::CookedMaterial& material = cd();
    for (auto _ : state)
        ::benchmark::DoNotOptimize(
            diffraction::fill_circle_map(texels, material.kernel, material.material.grating.pitch_nm,
                                         {.side = side, .views = std::max(std::min(2 * side, 128), 5 * side / 4)})
                .terms.xyz.data());
}

template <typename F, typename... Arguments>
void add_fill(const std::string& name, F function, Arguments... arguments) {
    ::benchmark::RegisterBenchmark(name.c_str(), function, arguments...)
        ->Unit(::benchmark::kMillisecond)
        ->UseRealTime();
}

}  // namespace

void register_map_fills() {
    for (const int side : {64, 128, 256}) add_fill("planar_fill/side:" + std::to_string(side), fill_planar, side);
    add_fill("planar_lobe_fill/64x64x32", fill_lobe, diffraction::kCoarseLobeMap);
    add_fill("planar_lobe_fill/352x128x128", fill_lobe, diffraction::LobeMapSize{});
    for (const int side : {32, 64, 104}) add_fill("circle_fill/side:" + std::to_string(side), fill_circle, side);
}

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

/// Spikes and transfer: 25 coefficients per vertex and colour.
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
