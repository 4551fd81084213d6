#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "modules/diffraction/runtime/gpu_representations.h"

namespace rowland::diffraction {

namespace {

/// Appends the texels of a row that one look-up of the terms reads.
void append(const CircleGrid& grid, int chart, int view, int row, int look_up, std::vector<glm::vec4>& texels) {
    for (int column = 0; column < grid.side; ++column) {
        glm::vec4& texel = texels.emplace_back(0.0F);
        for (int i = 0; i < 4; ++i) {
            const int component = 4 * look_up + i;
            if (component < 3 * grid.functions)
                texel[i] = grid.xyz[grid.index(chart, component / 3, view, row, column)][component % 3];
        }
    }
}

/// Four components of the terms' values per texel: circle.glsl. A pixel's look-ups lie within a row of the volume:
/// in separate rows they would evict each other from a processor's cache, as their addresses map to the same sets.
MapTexels terms_in_layout(const CircleGrid& grid, int charts) {
    std::array<std::vector<glm::vec4>, 1> texels;
    texels[0].reserve(static_cast<std::size_t>(grid.views * charts * grid.side) *
                      static_cast<std::size_t>(grid.side * kTermLookUps));
    for (int view = 0; view < grid.views; ++view)
        for (int chart = 0; chart < charts; ++chart)
            for (int row = 0; row < grid.side; ++row)
                for (int look_up = 0; look_up < kTermLookUps; ++look_up)
                    append(grid, chart, view, row, look_up, texels[0]);
    return pack(texels,
                {.kind = gpu::TextureKind::Volume,
                 .width = grid.side * kTermLookUps,
                 .height = grid.side * charts,
                 .depth = grid.views},
                {.filter = gpu::Filter::Linear});
}

/// The remainder's functions, also side by side.
std::optional<MapTexels> rest_in_layout(const CircleGrid& grid, int charts) {
    if (grid.functions == 0) return std::nullopt;
    std::vector<glm::vec3> texels;
    texels.reserve(grid.xyz.size());
    for (int view = 0; view < grid.views; ++view)
        for (int chart = 0; chart < charts; ++chart)
            for (int row = 0; row < grid.side; ++row)
                for (int angle = 0; angle < grid.functions; ++angle) {
                    const auto from =
                        grid.xyz.begin() + static_cast<std::ptrdiff_t>(grid.index(chart, angle, view, row, 0));
                    texels.insert(texels.end(), from, from + grid.side);
                }
    return pack_ten_bits(texels,
                         {.kind = gpu::TextureKind::Volume,
                          .width = grid.side * grid.functions,
                          .height = grid.side * charts,
                          .depth = grid.views},
                         {.filter = gpu::Filter::Linear, .wrap_s = gpu::Wrap::Repeat});
}

struct Filling {
    std::shared_ptr<const CookedMaterial> cooked;
    CircleMapSize full;
    glm::mat3 xyz_to_working;

    FilledMap operator()(const MapInput& input, MapDetail detail, const std::stop_token& stop) const {
        const CircleMapSize size = detail == MapDetail::Full ? full : coarser(full);
        const Grating& grating = cooked->material.grating;
        CircleMap map = fill_circle_map(*input.texels, cooked->kernel, grating.pitch_nm, size, cooked->zero_order_xyz,
                                        grating.cover, stop);
        if (stop.stop_requested()) return {};
        for (CircleGrid* grid : {&map.terms, &map.remainder})
            for (glm::vec3& value : grid->xyz) value = xyz_to_working * value;
        return {.texels = terms_in_layout(map.terms, map.charts),
                .second = rest_in_layout(map.remainder, map.charts),
                .set_uniforms = [scales = glm::vec4(map.terms.scale(), map.remainder.scale(), map.terms.view_scale(),
                                                    map.remainder.view_scale())](const gpu::Program& program) {
                    program.set("circle_map_scales", scales);
                }};
    }
};

}  // namespace

GpuCircle::GpuCircle(std::shared_ptr<const CookedMaterial> cooked, const CircleTables& tables,
                     const glm::dmat3& xyz_to_working)
    : GpuMaterial(std::move(cooked), xyz_to_working),
      size_(tables.size),
      charts_(chart_count(this->cooked()->kernel)),
      fill_(std::make_shared<const FillMap>(Filling{this->cooked(), tables.size, glm::mat3(xyz_to_working)})) {}

void GpuCircle::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    state.map.update(fill_, {.texels = samples(light)}, object.maps, object.may_wait);
    state.without_map = !state.map.shown();
}

void GpuCircle::describe(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    if (state.without_map) return;
    if (cooked()->material.quality.map_at_vertices) {
        set_vertex_shader(desc, "representations/circle/circle.glsl");
    } else {
        set_pixel_shader(desc, "representations/circle/circle.glsl", 2);
        // What a flat mirror shows changes little over a pixel.
        if (!state.flat) desc.defines.push_back({"MATERIAL_CURVED_MIRROR", "1"});
    }
    desc.defines.push_back({"CHARTS", std::to_string(charts_)});
    desc.defines.push_back({"ANGLES", std::to_string(size_.angles)});  // for half a turn
}

void GpuCircle::bind_tables(const gpu::Program& program, const SurfaceState& state) const {
    if (!state.without_map) state.map.shown()->bind(program);
}

}  // namespace rowland::diffraction
