#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <utility>

#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/representations/planar/lobe_map.h"
#include "modules/diffraction/representations/planar/planar_map.h"
#include "modules/diffraction/runtime/gpu_representations.h"

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

/// A map of XYZ under `light`. Where key lights are subtracted from the light, radiance may be negative.
MapTexels pack_map(const lighting::LightSamples& light, std::vector<glm::vec3> xyz, const gpu::TextureDesc& desc,
                   const gpu::Sampling& sampling) {
    const auto is_negative = [](float flux) { return flux < 0.0F; };
    for (const std::vector<float>* flux : {&light.red, &light.green, &light.blue})
        if (std::ranges::any_of(*flux, is_negative)) {
            const std::array levels{std::move(xyz)};
            return pack(levels, desc, sampling);
        }
    return pack_xyz(xyz, desc, sampling);
}

/// Maps of flat lobe.
struct FlatFilling {
    std::shared_ptr<const CookedMaterial> cooked;
    PlanarMapSize full;

    FilledMap operator()(const MapInput& input, MapDetail detail, const std::stop_token& stop) const {
        const PlanarMapSize size = detail == MapDetail::Full ? full : coarser(full);
        const Grating& grating = cooked->material.grating;
        PlanarMap map = fill_planar_map(*input.texels, cooked->kernel, grating.pitch_nm, input.normal, size,
                                        cooked->zero_order_xyz, grating.cover, stop);
        const auto kind = map.pitch ? gpu::TextureKind::Volume : gpu::TextureKind::Plane;
        return {.texels = pack_map(*input.texels, std::move(map.xyz),
                                   {.kind = kind, .width = map.azimuths, .height = map.views, .depth = map.slices()},
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
    std::shared_ptr<const DiffractionPattern> pattern;
    LobeMapSize full;
    Lazy<LobeSpectrum> coarse_slice;  ///< kept: it takes longer than the fill
    Lazy<LobeSpectrum> slice;

    LobeMap filled(const MapInput& input, MapDetail detail, const std::stop_token& stop) const {
        const bool coarse = detail == MapDetail::Coarse;
        if (input.grating)
            return fill_lobe_slice(*input.texels, coarse ? *coarse_slice : *slice, input.normal, *input.grating);
        const LobeMapSize size = coarse ? smaller(kCoarseLobeMap, full) : full;
        return fill_lobe_map(*input.texels, LobeSpectrum(*pattern, size.views), input.normal, size.azimuths, stop);
    }

    FilledMap operator()(const MapInput& input, MapDetail detail, const std::stop_token& stop) const {
        LobeMap map = filled(input, detail, stop);
        if (stop.stop_requested()) return {};
        const LobeMapSize& size = map.size;
        const int depth = slices(size, map.half_turn);
        return {.texels = pack_map(
                    *input.texels, std::move(map.values),
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

/// Fills the maps of a material's objects, in XYZ: planar_map.glsl. `tables`: of `cooked`.
std::shared_ptr<const FillMap> planar_filling(const std::shared_ptr<const CookedMaterial>& cooked,
                                              const PlanarTables& tables) {
    if (!tables.lobe) return std::make_shared<const FillMap>(FlatFilling{cooked, tables.size});
    const std::shared_ptr<const DiffractionPattern> pattern(cooked, &tables.lobe->pattern);
    const auto spectrum = [&](const LobeMapSize& size) {
        return Lazy<LobeSpectrum>([pattern, views = size.views] { return LobeSpectrum(*pattern, views); });
    };
    const LobeMapSize slice = one_azimuth(tables.lobe->size);
    return std::make_shared<const FillMap>(LobeFilling{.pattern = pattern,
                                                       .full = tables.lobe->size,
                                                       .coarse_slice = spectrum(smaller(kCoarseLobeSlice, slice)),
                                                       .slice = spectrum(slice)});
}

}  // namespace

GpuPlanar::GpuPlanar(std::shared_ptr<const CookedMaterial> cooked, const PlanarTables& tables,
                     const glm::dmat3& xyz_to_working)
    : GpuMaterial(std::move(cooked), xyz_to_working),
      stand_in_([material = this->cooked(), table = tables.stand_in, xyz_to_working] {
          return std::make_unique<const GpuArc>(material, *table, xyz_to_working);
      }),
      fill_(planar_filling(this->cooked(), tables)),
      lobe_map_(tables.lobe.has_value()),
      half_turn_(tables.lobe && tables.lobe->pattern.even),
      pitch_axis_(tables.size.pitch.has_value()) {}

MapInput GpuPlanar::map_input(const SurfaceObject& object, const SurfaceLight& light, const SurfaceState& state) const {
    const glm::dmat3 linear(object.object_to_world);
    MapInput input{.texels = samples(light), .normal = glm::normalize(glm::inverseTranspose(linear) * *state.flat)};
    if (lobe_map_ && !state.grooves && state.tangent)
        input.grating = glm::transpose(
            tangent_frame(glm::vec3(*state.flat), *state.tangent, object.object_to_world, object.groove_rotation))[0];
    return input;
}

void GpuPlanar::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    if (state.flat && samples(light))
        state.map.update(fill_, map_input(object, light, state), object.maps, object.may_wait);
    else
        state.map = {};
    const bool was_without = std::exchange(state.without_map, !state.map.shown());
    if (!state.without_map) {
        if (was_without) state.vertex_light = {};
        return;
    }
    if (was_without && !object.changed) return state.vertex_light.keep();
    if (!state.flat && !object.skinned && !was_without)
        log_warning("a grating of representation planar is on a mesh that is not flat: it is shaded as arc");
    SurfaceObject changed = object;
    changed.changed = true;
    (*stand_in_)->update(changed, light, state);
}

void GpuPlanar::describe(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    if (state.without_map || !state.flat) return (*stand_in_)->describe(state, desc);
    // The vertices do not read a groove texture.
    if (cooked()->material.quality.map_at_vertices && !state.grooves)
        set_vertex_shader(desc, "representations/planar/planar.glsl");
    else
        set_pixel_shader(desc, "representations/planar/planar.glsl");
    if (state.grooves) desc.defines.push_back({"FINE_GROOVE_PARTS", "1"});  // each is one look-up
    if (pitch_axis_) desc.defines.push_back({"PITCH_AXIS", "1"});
    if (lobe_map_) desc.defines.push_back({"LOBE_MAP", "1"});
    if (half_turn_) desc.defines.push_back({"HALF_TURN", "1"});
}

void GpuPlanar::bind_tables(const gpu::Program& program, const SurfaceState& state) const {
    if (state.without_map)
        (*stand_in_)->bind_tables(program, state);
    else
        state.map.shown()->bind(program);
}

}  // namespace rowland::diffraction
