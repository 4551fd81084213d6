#include "modules/diffraction/representations/circle/gpu_circle.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "modules/diffraction/runtime/flatness.h"

namespace rowland::diffraction {

namespace {

/// The texels of a row that one look-up reads.
void append(const CircleMap& map, int chart, int view, int row, int look_up, std::vector<glm::vec4>& texels) {
    for (int column = 0; column < map.side; ++column) {
        glm::vec4& texel = texels.emplace_back(0.0F);
        for (int i = 0; i < 4; ++i) {
            const int component = 4 * look_up + i;
            if (component < 3 * map.terms)
                texel[i] = map.xyz[map.index(chart, component / 3, view, row, column)][component % 3];
        }
    }
}

/// Four components of the terms' values per texel: circle_map.glsl. A pixel's look-ups lie within a row of the volume:
/// below each other they would share sets of a processor's cache.
MapTexels in_layout(const CircleMap& map) {
    const int look_ups = look_ups_of(map.terms);
    std::array<std::vector<glm::vec4>, 1> levels;
    std::vector<glm::vec4>& texels = levels[0];
    texels.reserve(map.xyz.size() / static_cast<std::size_t>(map.terms) * static_cast<std::size_t>(look_ups));
    for (int view = 0; view < map.views; ++view)
        for (int chart = 0; chart < map.charts; ++chart)
            for (int row = 0; row < map.side; ++row)
                for (int look_up = 0; look_up < look_ups; ++look_up) append(map, chart, view, row, look_up, texels);
    return pack(levels,
                {.kind = gpu::TextureKind::Volume,
                 .width = map.side * look_ups,
                 .height = map.side * map.charts,
                 .depth = map.views},
                {.filter = gpu::Filter::Linear});
}

struct Filling {
    MaterialKernel material;
    CircleMapSize full;

    FilledMap operator()(const MapInput& input, MapDetail detail, const std::stop_token& stop) const {
        CircleMapSize size = full;
        if (detail == MapDetail::Coarse) size.side = std::min(size.side, kCoarseCircleSide);
        const CircleMap map = fill_circle_map(*input.texels, material.kernel, material.pitch_nm, size,
                                              material.zero_order_xyz, material.cover, stop);
        if (stop.stop_requested()) return {};
        return {.texels = in_layout(map), .set_uniforms = [scale = map.scale()](const gpu::Program& program) {
                    program.set("circle_map_scale", static_cast<float>(scale));
                }};
    }
};

}  // namespace

GpuCircle::GpuCircle(const CookedMaterial& cooked, const CircleTables& tables, const glm::dmat3& xyz_to_working)
    : GpuMaterial(cooked, xyz_to_working),
      size_(tables.size),
      charts_(chart_count(working_material().kernel)),
      fill_(std::make_shared<const FillMap>(Filling{working_material(), tables.size})) {}

void GpuCircle::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    if (!state.data) state.data = std::make_unique<CircleData>();
    auto& data = static_cast<CircleData&>(*state.data);
    if (data.mesh != state.mesh || !state.mesh) {
        data.mesh = state.mesh;
        data.flat = !object.skinned && flat_normal(object.mesh).has_value();
    }
    map_.update({.texels = light.texels(light_part())}, fill_, object.map_pace);
}

void GpuCircle::describe(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    if (cooked()->material.quality.map_at_vertices) {
        set_vertex_shader(desc, "representations/circle/circle.vert.glsl");
    } else {
        set_shaders(desc, "shaders/pixel_shaded.vert.glsl", "representations/circle/circle.frag.glsl");
        if (!static_cast<const CircleData&>(*state.data).flat) desc.defines.push_back({"MATERIAL_CURVED_MIRROR", "1"});
    }
    desc.defines.push_back({"CHARTS", std::to_string(charts_)});
    desc.defines.push_back({"TERMS", std::to_string(size_.terms)});
    desc.defines.push_back({"LOOK_UPS", std::to_string(look_ups_of(size_.terms))});
    desc.defines.push_back({"VIEWS", std::to_string(size_.views)});
}

void GpuCircle::bind_tables(const gpu::Program& program, const SurfaceState&) const {
    map_.bind(program);
}

}  // namespace rowland::diffraction
