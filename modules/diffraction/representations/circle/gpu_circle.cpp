#include "modules/diffraction/representations/circle/gpu_circle.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace rowland::diffraction {

namespace {

/// Charts side by side and terms below each other, for one volume texture.
MapTexels in_layout(const CircleMap& map) {
    std::array<std::vector<glm::vec3>, 1> levels;
    levels[0].reserve(map.xyz.size());
    for (int view = 0; view < map.views; ++view)
        for (int term = 0; term < map.terms; ++term)
            for (int row = 0; row < map.side; ++row)
                for (int chart = 0; chart < map.charts; ++chart) {
                    const auto from =
                        map.xyz.begin() + static_cast<std::ptrdiff_t>(map.index(chart, term, view, row, 0));
                    levels[0].insert(levels[0].end(), from, from + map.side);
                }
    return pack(levels,
                {.kind = gpu::TextureKind::Volume,
                 .width = map.side * map.charts,
                 .height = map.side * map.terms,
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

void GpuCircle::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState&) const {
    map_.update({.texels = light.texels(light_part())}, fill_, object.map_pace);
}

void GpuCircle::describe(const SurfaceState&, gpu::ProgramDesc& desc) const {
    if (cooked()->material.quality.map_at_vertices)
        set_vertex_shader(desc, "representations/circle/circle.vert.glsl");
    else
        set_shaders(desc, "shaders/pixel_shaded.vert.glsl", "representations/circle/circle.frag.glsl");
    desc.defines.push_back({"CHARTS", std::to_string(charts_)});
    desc.defines.push_back({"TERMS", std::to_string(size_.terms)});
    desc.defines.push_back({"VIEWS", std::to_string(size_.views)});
}

void GpuCircle::bind_tables(const gpu::Program& program, const SurfaceState&) const {
    map_.bind(program);
}

}  // namespace rowland::diffraction
