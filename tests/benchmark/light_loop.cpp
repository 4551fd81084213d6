#include "tests/benchmark/light_loop.h"

#include <cmath>
#include <glm/matrix.hpp>
#include <span>
#include <string>

#include "engine/colour/light_spectra.h"
#include "engine/colour/observer.h"
#include "engine/colour/sampled_spectrum.h"
#include "engine/colour/working_space.h"
#include "modules/diffraction/asset/layer_weights.h"
#include "modules/diffraction/model/efficiency.h"
#include "tests/benchmark/shader_files.h"

namespace rowland::benchmark {

namespace {

constexpr unsigned kColoursUnit = 8;  ///< the first of a material type's own

gpu::Texture make_colours(const diffraction::Grating& grating) {
    constexpr int kCount = colour::kVisibleMax - colour::kVisibleMin + 1;
    const colour::LightSpectra spectra;
    std::vector<glm::vec4> texels;
    for (const int order : grating.orders)
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < kCount; ++i) {
                const double wavelength_nm = colour::kVisibleMin + i;
                const double weight = diffraction::order_efficiency(grating, order, wavelength_nm) * grating.pitch_nm /
                                      std::abs(order) * spectra(wavelength_nm)[c];
                texels.emplace_back(glm::vec3(weight * colour::cie_xyz(wavelength_nm)), 0.0F);
            }
    gpu::Texture texture(
        {.format = gpu::Format::RGBA32F, .width = kCount, .height = static_cast<int>(3 * grating.orders.size())},
        {.filter = gpu::Filter::Linear});
    texture.upload(std::span<const glm::vec4>(texels));
    return texture;
}

}  // namespace

LightLoopType::LightLoopType(const diffraction::Grating& grating, const glm::dmat3& xyz_to_working)
    : pitch_nm_(static_cast<float>(grating.pitch_nm)),
      orders_(grating.orders),
      colours_(make_colours(grating)),
      working_to_rec709_(glm::inverse(xyz_to_working * colour::rec709_to_xyz())) {
    const diffraction::LayerWeights weights = diffraction::layer_weights(grating);
    mirror_weight_ = glm::vec3(xyz_to_working * weights.mirror);
    base_weight_ = glm::vec3(xyz_to_working * weights.base);
}

void LightLoopType::add_shaders(gpu::ShaderLibrary& library) const {
    library.add_embedded(shader_files());
}

bool LightLoopType::owns(ecs::World& world, ecs::Entity entity) const {
    return world.find<LightLoop>(entity) != nullptr;
}

gpu::ProgramDesc LightLoopType::program(ecs::World&, ecs::Entity) const {
    gpu::ProgramDesc desc;
    desc.vertex = "tests/benchmark/shaders/light_loop.vert.glsl";
    desc.fragment = "tests/benchmark/shaders/light_loop.frag.glsl";
    desc.defines.push_back({"ORDERS", std::to_string(orders_.size())});
    return desc;
}

void LightLoopType::bind(ecs::World&, ecs::Entity, const gpu::Program& program) const {
    colours_.bind(kColoursUnit);
    program.set("pitch_nm", pitch_nm_);
    program.set("orders", std::span<const int>(orders_));
    program.set("working_to_rec709", working_to_rec709_);
    program.set("mirror_weight", mirror_weight_);
    program.set("base_weight", base_weight_);
}

}  // namespace rowland::benchmark
