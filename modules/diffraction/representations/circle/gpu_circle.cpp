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
void append(const CircleLevel& level, int chart, int view, int row, int look_up, std::vector<glm::vec4>& texels) {
    for (int column = 0; column < level.side; ++column) {
        glm::vec4& texel = texels.emplace_back(0.0F);
        for (int i = 0; i < 4; ++i) {
            const int component = 4 * look_up + i;
            if (component < 3 * level.terms)
                texel[i] = level.xyz[level.index(chart, component / 3, view, row, column)][component % 3];
        }
    }
}

/// Look-ups that lie side by side in the texture, in either level.
int look_ups_abreast(int terms) {
    const std::array<int, 2> look_ups = look_ups_of(terms);
    return std::max(look_ups[0], look_ups[1]);
}

/// Four components of the terms' values per texel: circle_map.glsl. A pixel's look-ups lie within a row of the volume:
/// below each other they would share sets of a processor's cache.
MapTexels in_layout(const CircleMap& map) {
    const CircleLevel& fine = map.levels[0];
    const int abreast = look_ups_abreast(fine.terms + map.levels[1].terms);
    std::vector<std::vector<glm::vec4>> levels;
    for (const CircleLevel& level : map.levels) {
        if (level.terms == 0) continue;
        std::vector<glm::vec4>& texels = levels.emplace_back();
        texels.reserve(static_cast<std::size_t>(level.views * map.charts * level.side) *
                       static_cast<std::size_t>(level.side * abreast));
        for (int view = 0; view < level.views; ++view)
            for (int chart = 0; chart < map.charts; ++chart)
                for (int row = 0; row < level.side; ++row)
                    for (int look_up = 0; look_up < abreast; ++look_up)
                        append(level, chart, view, row, look_up, texels);
    }
    return pack(levels,
                {.kind = gpu::TextureKind::Volume,
                 .width = fine.side * abreast,
                 .height = fine.side * map.charts,
                 .depth = fine.views},
                {.filter = gpu::Filter::Trilinear});
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
        return {.texels = in_layout(map),
                .set_uniforms = [scales = glm::vec2(glm::dvec2(map.levels[0].scale(), map.levels[1].scale()))](
                                    const gpu::Program& program) { program.set("circle_map_scales", scales); }};
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
    desc.defines.push_back({"LOOK_UPS", std::to_string(look_ups_abreast(size_.terms))});
    desc.defines.push_back({"VIEWS", std::to_string(size_.views)});
}

void GpuCircle::bind_tables(const gpu::Program& program, const SurfaceState&) const {
    map_.bind(program);
}

}  // namespace rowland::diffraction
