#include "modules/diffraction/runtime/gpu_material.h"

#include <cmath>
#include <string>
#include <variant>

#include "modules/diffraction/asset/layer_weights.h"
#include "modules/diffraction/runtime/gpu_arc.h"
#include "modules/diffraction/runtime/gpu_bins.h"
#include "modules/diffraction/runtime/gpu_circle.h"
#include "modules/diffraction/runtime/gpu_direct.h"
#include "modules/diffraction/runtime/gpu_planar.h"
#include "modules/diffraction/runtime/gpu_spikes.h"
#include "modules/diffraction/runtime/gpu_transfer.h"

namespace rowland::diffraction {

namespace {

/// The class that draws each kind of tables.
template <typename Tables>
struct Drawn;
template <>
struct Drawn<SpikeTable> {
    using By = GpuSpikes;
};
template <>
struct Drawn<BinTable> {
    using By = GpuBins;
};
template <>
struct Drawn<TransferTable> {
    using By = GpuTransfer;
};
template <>
struct Drawn<ArcTable> {
    using By = GpuArc;
};
template <>
struct Drawn<DirectTables> {
    using By = GpuDirect;
};
template <>
struct Drawn<PlanarTables> {
    using By = GpuPlanar;
};
template <>
struct Drawn<CircleTables> {
    using By = GpuCircle;
};

}  // namespace

GpuMaterial::GpuMaterial(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working)
    : base_{.base_colour = cooked.material.base.colour, .metallic = 0.0F, .roughness = cooked.material.base.roughness},
      illuminant_(cooked.material.quality.illuminant.name),
      key_lights_(cooked.material.quality.key_lights),
      kernel_(cooked, xyz_to_working) {
    const LayerWeights weights = layer_weights(cooked.material.grating, cooked.material.quality.illuminant);
    mirror_weight_ = glm::vec3(xyz_to_working * weights.mirror);
    base_weight_ = glm::vec3(xyz_to_working * weights.base);
}

gpu::ProgramDesc GpuMaterial::program(const SurfaceState& state) const {
    gpu::ProgramDesc desc;
    describe(state, desc);
    if (key_lights_) desc.defines.push_back({"SEPARATE_LIGHTS", "1"});
    kernel_.add_defines(desc);
    return desc;
}

void GpuMaterial::bind(const gpu::Program& program, const SurfaceLight& light, const SurfaceState& state) const {
    bind_tables(program, state);
    kernel_.bind(program);
    if (key_lights_) light.bind_key_lights();
    program.set("mirror_weight", mirror_weight_);
    program.set("base_weight", base_weight_);
    program.set("groove_turn", glm::vec2(std::cos(state.groove_rotation), std::sin(state.groove_rotation)));
}

std::shared_ptr<const GpuMaterial> make_gpu_material(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working) {
    return std::visit(
        [&]<typename Tables>(const Tables& tables) -> std::shared_ptr<const GpuMaterial> {
            return std::make_shared<const typename Drawn<Tables>::By>(cooked, tables, xyz_to_working);
        },
        cooked.tables);
}

void set_shaders(gpu::ProgramDesc& desc, const char* vertex, const char* fragment) {
    desc.vertex = std::string("modules/diffraction/shaders/") + vertex;
    desc.fragment = std::string("modules/diffraction/shaders/") + fragment;
}

}  // namespace rowland::diffraction
