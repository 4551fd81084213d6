// Filling the maps that depend on the light: at run time, when a flat object has turned or the probe has changed.
#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "engine/lighting/studio.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/representations/circle/circle_map.h"
#include "modules/diffraction/representations/planar/lobe_map.h"
#include "modules/diffraction/representations/planar/planar_map.h"
#include "tests/benchmark/cd_materials.h"
#include "tests/benchmark/microbenchmarks.h"

namespace rowland::microbenchmark {

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
void add(const std::string& name, F function, Arguments... arguments) {
    ::benchmark::RegisterBenchmark(name.c_str(), function, arguments...)
        ->Unit(::benchmark::kMillisecond)
        ->UseRealTime();
}

}  // namespace

void register_map_fills() {
    for (const int side : {64, 128, 256}) add("planar_fill/side:" + std::to_string(side), fill_planar, side);
    add("planar_lobe_fill/64x64x32", fill_lobe, diffraction::kCoarseLobeMap);
    add("planar_lobe_fill/352x128x128", fill_lobe, diffraction::LobeMapSize{});
    for (const int side : {32, 64, 104}) add("circle_fill/side:" + std::to_string(side), fill_circle, side);
}

}  // namespace rowland::microbenchmark
