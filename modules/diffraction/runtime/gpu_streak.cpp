#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/gpu_representations.h"

namespace rowland::diffraction {

namespace {

/// StreakSegment of streak.glsl, std430.
struct ShaderSegment {
    glm::vec4 first_step;  ///< x: first path over the pitch; y: step over the pitch
    /// For each node the columns of its weight, for red, green and blue light, in the working space.
    std::array<glm::vec4, std::size_t{3} * kSegmentNodes> weights;
};
static_assert(sizeof(ShaderSegment) == 16 * (1 + std::size_t{3} * kSegmentNodes));

ShaderSegment shader_segment(const StreakSegment& segment, double pitch_nm, const glm::dmat3& xyz_to_working) {
    const auto pitch = static_cast<float>(pitch_nm);
    ShaderSegment made{.first_step = {segment.first_nm / pitch, segment.step_nm / pitch, 0.0F, 0.0F}, .weights = {}};
    for (std::size_t i = 0; i < made.weights.size(); ++i)
        made.weights[i] = glm::vec4(
            glm::vec3(xyz_to_working * glm::dvec3(segment.weights[i / 3][static_cast<glm::length_t>(i % 3)])), 0.0F);
    return made;
}

gpu::Buffer segment_buffer(const StreakTables& tables, const glm::dmat3& xyz_to_working) {
    std::vector<ShaderSegment> segments;
    for (const StreakSegment& segment : tables.streak.segments)
        segments.push_back(shader_segment(segment, tables.streak.pitch_nm, xyz_to_working));
    if (segments.empty()) segments.push_back({.first_step = {4.0F, 0.0F, 0.0F, 0.0F}, .weights = {}});  // never visible
    return gpu::Buffer::of(std::span<const ShaderSegment>(segments));
}

/// A quarter of the side is filled in a sixteenth of the time; lights are wider then.
StreakMapSize coarser(StreakMapSize size) {
    size.side = std::max(8, size.side / 16 * 4);
    return size;
}

FilledMap fill(const StreakMapSize& full, const MapInput& input, MapDetail detail, const std::stop_token& stop) {
    const StreakMap map = fill_streak_map(*input.texels, detail == MapDetail::Full ? full : coarser(full), stop);
    if (stop.stop_requested()) return {};
    return {
        .texels = pack(
            map.levels,
            {.kind = gpu::TextureKind::Volume, .width = map.columns(0), .height = map.rows(0), .depth = map.slices(0)},
            {.filter = gpu::Filter::Trilinear, .wrap_r = gpu::Wrap::Repeat}),
        .set_uniforms = nullptr};
}

}  // namespace

GpuStreak::GpuStreak(std::shared_ptr<const CookedMaterial> cooked, const StreakTables& tables,
                     const glm::dmat3& xyz_to_working)
    : GpuMaterial(std::move(cooked), xyz_to_working),
      segments_(segment_buffer(tables, xyz_to_working)),
      reach_(static_cast<float>(tables.streak.reach())),
      level_(static_cast<float>(std::log2(tables.streak.sigma / tables.map.length))),
      power_(static_cast<float>(tables.streak.power / std::erf(1.0 / (tables.streak.sigma * std::numbers::sqrt2)))),
      arc_fraction_(static_cast<float>(1.0 - tables.streak.power)),
      fill_(std::make_shared<const FillMap>(
          [size = tables.map](const MapInput& input, MapDetail detail, const std::stop_token& stop) {
              return fill(size, input, detail, stop);
          })) {
    if (tables.incoherent) incoherent_.emplace(this->cooked(), *tables.incoherent, xyz_to_working);
}

void GpuStreak::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    if (incoherent_) incoherent_->update(object, light, state);
    state.map.update(fill_, {.texels = light.probe_samples(0)}, object.maps, object.may_wait);
    state.without_map = !state.map.shown();
}

void GpuStreak::describe(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    if (state.without_map) return;
    if (incoherent_) {
        incoherent_->describe(state, desc);
        desc.defines.push_back({"REST", "1"});
    }
    set_pixel_shader(desc, "representations/streak/streak.glsl");
    desc.defines.push_back({"STREAK", "1"});
    desc.defines.push_back({"NODES", std::to_string(kSegmentNodes)});
}

void GpuStreak::bind_tables(const gpu::Program& program, const SurfaceState& state) const {
    if (state.without_map) return;
    if (incoherent_) incoherent_->bind_tables(program, state);
    segments_.bind_storage(kStreakSegmentBinding);
    state.map.shown()->bind(program);
    program.set("streak_level", level_);
    program.set("streak_reach", reach_);
    program.set("streak_power", power_);
    program.set("rest_weight", arc_fraction_);
}

}  // namespace rowland::diffraction
