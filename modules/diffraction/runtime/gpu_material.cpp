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
#include "modules/diffraction/runtime/gpu_streak.h"
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
template <>
struct Drawn<StreakTables> {
    using By = GpuStreak;
};

/// Maps are of a probe, which has no directional lights.
bool is_map(const BakedTables& tables) {
    return std::holds_alternative<PlanarTables>(tables) || std::holds_alternative<CircleTables>(tables);
}

}  // namespace

GpuMaterial::GpuMaterial(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working)
    : cooked_(std::make_shared<const CookedMaterial>(cooked)),
      base_{.base_colour = cooked.material.base.colour, .metallic = 0.0F, .roughness = cooked.material.base.roughness},
      key_lights_(cooked.material.quality.key_lights),
      separate_lights_(key_lights_ || is_map(cooked.tables)),
      lights_at_vertices_(cooked.material.quality.lights_at_vertices && cooked.zero_order_xyz == glm::dmat3(0.0)),
      kernel_(cooked, xyz_to_working) {
    const LayerWeights weights = layer_weights(cooked.material.grating, cooked.material.quality.illuminant);
    mirror_weight_ = glm::vec3(xyz_to_working * weights.mirror);
    base_weight_ = glm::vec3(xyz_to_working * weights.base);
}

gpu::ProgramDesc GpuMaterial::program(const SurfaceState& state) const {
    gpu::ProgramDesc desc;
    describe(state, desc);
    if (separate_lights_) desc.defines.push_back({"SEPARATE_LIGHTS", "1"});
    if (!key_lights_) desc.defines.push_back({"NO_KEY_LIGHTS", "1"});
    kernel_.add_defines(desc);
    if (state.grooves) state.grooves->add_defines(desc);
    if (lights_at_vertices_ && !state.grooves) desc.defines.push_back({"LIGHTS_AT_VERTICES", "1"});
    return desc;
}

void GpuMaterial::bind(const gpu::Program& program, const SurfaceLight& light, const SurfaceState& state) const {
    bind_tables(program, state);
    kernel_.bind(program, light.key_lights(), light.light_colours());
    light.bind_light_colours();
    if (key_lights_) light.bind_key_lights();
    if (state.grooves) state.grooves->bind(program);
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

void set_vertex_shader(gpu::ProgramDesc& desc, const char* vertex) {
    set_shaders(desc, vertex, "vertex_shaded.frag.glsl");
    desc.defines.push_back({"VERTEX_SHADED", "1"});
}

}  // namespace rowland::diffraction
