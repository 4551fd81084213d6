#include "modules/diffraction/representations/planar/planar_filling.h"

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <utility>

#include "engine/core/lazy.h"
#include "modules/diffraction/representations/planar/lobe_map.h"
#include "modules/diffraction/representations/planar/planar_map.h"

namespace rowland::diffraction {

namespace {

PlanarMapSize coarser(PlanarMapSize size) {
    size.azimuths = std::min(kCoarsePlanarMap.azimuths, size.azimuths);
    size.views = std::min(kCoarsePlanarMap.views, size.views);
    if (size.pitch) size.pitch->nodes = std::max(2, size.pitch->nodes / 2);
    return size;
}

LobeMapSize smaller(const LobeMapSize& a, const LobeMapSize& b) {
    return {.azimuths = std::min(a.azimuths, b.azimuths),
            .views = {.g = std::min(a.views.g, b.views.g), .h = std::min(a.views.h, b.views.h)}};
}

void set_axes(const gpu::Program& program, const glm::dvec3& e1, const glm::dvec3& e2) {
    program.set("planar_e1", glm::vec3(e1));
    program.set("planar_e2", glm::vec3(e2));
}

/// Maps of flat lobe.
struct FlatFilling {
    MaterialKernel material;
    PlanarMapSize full;

    FilledMap operator()(const MapInput& input, MapDetail detail, const std::stop_token& stop) const {
        const PlanarMapSize size = detail == MapDetail::Full ? full : coarser(full);
        PlanarMap map = fill_planar_map(*input.texels, material.kernel, material.pitch_nm, input.normal, size,
                                        material.zero_order_xyz, material.cover, stop);
        const std::array levels{std::move(map.xyz)};
        const auto kind = map.pitch ? gpu::TextureKind::Volume : gpu::TextureKind::Plane;
        return {
            .texels = pack(levels, {.kind = kind, .width = map.azimuths, .height = map.views, .depth = map.slices()},
                           {.filter = gpu::Filter::Linear, .wrap_s = gpu::Wrap::Repeat}),
            .set_uniforms = [e1 = map.e1, e2 = map.e2, size](const gpu::Program& program) {
                set_axes(program, e1, e2);
                if (size.pitch) program.set("pitch_scale_bias", glm::vec2(size.pitch->scale_bias()));
                program.set("planar_map_half_texel", glm::vec2(0.5 / glm::dvec2(size.azimuths, size.views)));
            }};
    }
};

/// Volume maps of other lobes.
struct LobeFilling {
    struct Level {
        int azimuths;
        Lazy<LobeSpectrum> spectrum;
    };
    struct Levels {
        Level coarse;
        Level full;
    };
    Levels all;  ///< azimuths
    Levels one;

    FilledMap operator()(const MapInput& input, MapDetail detail, const std::stop_token& stop) const {
        const Levels& levels_of = input.grating ? one : all;
        const Level& level = detail == MapDetail::Full ? levels_of.full : levels_of.coarse;
        LobeMap map = input.grating ? fill_lobe_slice(*input.texels, *level.spectrum, input.normal, *input.grating)
                                    : fill_lobe_map(*input.texels, *level.spectrum, input.normal, level.azimuths, stop);
        if (stop.stop_requested()) return {};
        const LobeMapSize& size = map.size;
        const int depth = slices(size, map.half_turn);
        const std::array levels{std::move(map.values)};
        return {.texels = pack(
                    levels,
                    {.kind = gpu::TextureKind::Volume, .width = size.views.g, .height = size.views.h, .depth = depth},
                    {.filter = gpu::Filter::Linear, .wrap_r = map.half_turn ? gpu::Wrap::Clamp : gpu::Wrap::Repeat}),
                .set_uniforms = [axes = map.axes, size, depth](const gpu::Program& program) {
                    set_axes(program, axes.e1, axes.e2);
                    program.set("lobe_map_axes",
                                glm::vec4(glm::dvec4(0.5 - 0.5 / size.views.g, 0.5 - 0.5 / size.views.h,
                                                     static_cast<double>(size.azimuths) / depth, 0.5 / depth)));
                }};
    }
};

}  // namespace

std::shared_ptr<const FillMap> planar_filling(const PlanarTables& tables, const MaterialKernel& material,
                                              const glm::dmat3& xyz_to_working) {
    if (!tables.lobe) return std::make_shared<const FillMap>(FlatFilling{material, tables.size});
    const auto pattern = std::make_shared<const DiffractionPattern>(in_space(tables.lobe->pattern, xyz_to_working));
    const auto levels = [&](const LobeMapSize& coarse, const LobeMapSize& full) {
        const auto level = [&](const LobeMapSize& size) {
            return LobeFilling::Level{size.azimuths, Lazy<LobeSpectrum>([pattern, views = size.views] {
                                          return LobeSpectrum(*pattern, views);
                                      })};
        };
        return LobeFilling::Levels{level(smaller(coarse, full)), level(full)};
    };
    const LobeMapSize& size = tables.lobe->size;
    return std::make_shared<const FillMap>(
        LobeFilling{.all = levels(kCoarseLobeMap, size), .one = levels(kCoarseLobeSlice, one_azimuth(size))});
}

}  // namespace rowland::diffraction
