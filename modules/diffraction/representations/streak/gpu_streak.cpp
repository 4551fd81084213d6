#include "modules/diffraction/representations/streak/gpu_streak.h"

#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

namespace {

/// StreakNode of shaders/streak.frag.glsl, std430.
struct ShaderNode {
    glm::vec4 path_width;  ///< x: path over the pitch; y: width over the pitch
    glm::vec4 weight[3];   ///< columns: of red, green and blue light, working space
};
static_assert(sizeof(ShaderNode) == 64);

gpu::Buffer node_buffer(const Streak& streak, const glm::dmat3& xyz_to_working) {
    std::vector<ShaderNode> nodes;
    for (const StreakNode& node : streak.nodes) {
        const auto pitch = static_cast<float>(streak.pitch_nm);
        ShaderNode made{.path_width = {node.path_nm / pitch, node.width_nm / pitch, 0.0F, 0.0F}, .weight = {}};
        for (int c = 0; c < 3; ++c)
            made.weight[c] = glm::vec4(glm::vec3(xyz_to_working * glm::dvec3(node.weight[c])), 0.0F);
        nodes.push_back(made);
    }
    if (nodes.empty()) nodes.push_back({.path_width = {4.0F, 0.0F, 0.0F, 0.0F}, .weight = {}});  // never visible
    return gpu::Buffer::of(std::span<const ShaderNode>(nodes));
}

std::vector<glm::vec3> shader_taps(const StreakTables& tables) {
    std::vector<glm::vec3> taps;
    for (const LobeTap& tap : lobe_taps(tables.taps))
        taps.emplace_back(glm::dvec3(tables.streak.sigma * tap.offset, tables.streak.sigma * tap.width, tap.weight));
    return taps;
}

}  // namespace

GpuStreak::GpuStreak(const CookedMaterial& cooked, const StreakTables& tables, const glm::dmat3& xyz_to_working)
    : GpuMaterial(cooked, xyz_to_working),
      nodes_(node_buffer(tables.streak, xyz_to_working)),
      taps_(shader_taps(tables)),
      power_(static_cast<float>(tables.streak.power / std::erf(1.0 / (tables.streak.sigma * std::numbers::sqrt2)))),
      rest_weight_(static_cast<float>(1.0 - tables.streak.power)) {
    if (tables.rest) rest_.emplace(cooked, *tables.rest, xyz_to_working);
}

void GpuStreak::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    radiance_ = light.radiance();
    if (rest_) rest_->update(object, light, state);
}

void GpuStreak::describe(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    set_shaders(desc, "shaders/pixel_shaded.vert.glsl", "representations/streak/streak.frag.glsl");
    if (rest_) {
        rest_->describe(state, desc);
        set_shaders(desc, "representations/arc/arc.vert.glsl", "representations/streak/streak.frag.glsl");
        desc.defines.push_back({"REST", "1"});
    }
    desc.defines.push_back({"STREAK", "1"});
    desc.defines.push_back({"TAPS", std::to_string(taps_.size())});
    desc.defines.push_back({"FILTER_TAPS", std::to_string(kStreakFilterTaps) + ".0"});
}

void GpuStreak::bind_tables(const gpu::Program& program, const SurfaceState& state) const {
    if (rest_) rest_->bind_tables(program, state);
    nodes_.bind_storage(kStreakNodeBinding);
    radiance_->bind(program);
    program.set("streak_taps", std::span<const glm::vec3>(taps_));
    program.set("streak_power", power_);
    program.set("rest_weight", rest_weight_);
}

}  // namespace rowland::diffraction
