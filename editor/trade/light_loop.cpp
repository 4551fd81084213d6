#include "editor/trade/light_loop.h"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>

#include "editor/trade/embedded_files.h"
#include "engine/colour/observer.h"
#include "engine/colour/sampled_spectrum.h"
#include "engine/core/error.h"
#include "modules/diffraction/asset/layer_weights.h"
#include "modules/diffraction/model/efficiency.h"
#include "modules/diffraction/shaders/shader_files.h"

namespace rowland::trade {

namespace {

constexpr unsigned kLightBinding = 4;
constexpr unsigned kColourUnit = 8;
constexpr int kWavelengths = colour::kVisibleMax - colour::kVisibleMin + 1;
constexpr std::size_t kMostOrders = 64;  ///< as in light_loop.frag.glsl

std::vector<float> orders_other_than_0(const diffraction::Grating& grating) {
    std::vector<float> orders;
    for (const int order : grating.orders)
        if (order != 0) orders.push_back(static_cast<float>(order));
    return orders;
}

/// ½ d/|m| η_m cmf E: the XYZ that a light of irradiance 1, normal to the surface, adds (PHYSICS §4).
gpu::Texture colour_rows(const diffraction::Grating& grating, std::span<const float> orders,
                         const colour::LightSpectra& spectra) {
    std::vector<glm::vec4> texels;
    for (const float order : orders)
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < kWavelengths; ++i) {
                const double wavelength_nm = colour::kVisibleMin + i;
                const double weight = 0.5 * grating.pitch_nm / std::abs(order) *
                                      diffraction::order_efficiency(grating, static_cast<int>(order), wavelength_nm) *
                                      spectra(wavelength_nm)[c];
                texels.emplace_back(glm::vec3(weight * colour::cie_xyz(wavelength_nm)), 0.0F);
            }
    gpu::Texture texture({.format = gpu::Format::RGBA32F,
                          .width = kWavelengths,
                          .height = std::max(1, 3 * static_cast<int>(orders.size()))});
    if (!texels.empty()) texture.upload(std::span<const glm::vec4>(texels));
    return texture;
}

}  // namespace

LightLoop::LightLoop(const diffraction::Grating& grating, const colour::LightSpectra& spectra,
                     const glm::dmat3& xyz_to_working)
    : pitch_nm_(grating.pitch_nm), orders_(orders_other_than_0(grating)) {
    if (grating.lattice || !is_flat(grating.lobe) || grating.cover || grating.transmission ||
        grating.grooves < diffraction::kManyGrooves || orders_.size() > kMostOrders)
        refuse_input("light loop", {}, "another grating",
                     "a flat groove_lobe without a cover or a transmission, sharp orders (50 grooves or more), at most "
                     "64 of them");
    const diffraction::LayerWeights weights = diffraction::layer_weights(grating);
    mirror_weight_ = glm::vec3(xyz_to_working * weights.mirror);
    base_weight_ = glm::vec3(xyz_to_working * weights.base);
    colours_ = colour_rows(grating, orders_, spectra);
    set_lights({});
}

void LightLoop::set_lights(std::span<const render::DistantLight> lights) {
    std::vector<glm::vec4> values;
    for (const render::DistantLight& light : lights) {
        values.emplace_back(light.direction, 0.0F);
        values.emplace_back(light.irradiance, 0.0F);
    }
    light_count_ = static_cast<int>(lights.size());
    if (values.empty()) values.resize(2);
    lights_ = gpu::Buffer::of(std::span<const glm::vec4>(values));
}

void LightLoop::bind(const gpu::Program& program) const {
    colours_.bind(kColourUnit);
    lights_.bind_storage(kLightBinding);
    program.set("light_count", light_count_);
    program.set("order_count", orders());
    program.set("orders", std::span<const float>(orders_));
    program.set("pitch_nm", static_cast<float>(pitch_nm_));
    program.set("groove_turn", glm::vec2(1.0F, 0.0F));
    program.set("mirror_weight", mirror_weight_);
    program.set("base_weight", base_weight_);
}

void LightLoopType::add_shaders(gpu::ShaderLibrary& library) const {
    library.add_embedded(diffraction::shader_files());
    library.add_embedded(light_loop_files());
}

bool LightLoopType::owns(ecs::World& world, ecs::Entity entity) const {
    return world.find<LightLoopSurface>(entity) != nullptr;
}

gpu::ProgramDesc LightLoopType::program(ecs::World& /*world*/, ecs::Entity /*entity*/) const {
    return {.vertex = "modules/diffraction/shaders/pixel_shaded.vert.glsl",
            .fragment = "editor/trade/light_loop.frag.glsl"};
}

void LightLoopType::bind(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const {
    world.get<LightLoopSurface>(entity).loop->bind(program);
}

}  // namespace rowland::trade
