#include "modules/diffraction/representations/circle/gpu_circle.h"

#include <glm/gtc/packing.hpp>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/log.h"

namespace rowland::diffraction {

namespace {

/// Charts side by side and terms below each other, for one volume texture.
MapTexels in_layout(const CircleMap& map) {
    MapTexels texels{.desc = {.kind = gpu::TextureKind::Volume,
                              .width = map.side * map.charts,
                              .height = map.side * map.terms,
                              .depth = map.views},
                     .sampling = {.filter = gpu::Filter::Linear},
                     .scale = largest_component(map.xyz),
                     .halves = {}};
    texels.halves.reserve(4 * map.xyz.size());
    for (int view = 0; view < map.views; ++view)
        for (int term = 0; term < map.terms; ++term)
            for (int row = 0; row < map.side; ++row)
                for (int chart = 0; chart < map.charts; ++chart) {
                    const glm::vec3* from = map.xyz.data() + map.index(chart, term, view, row, 0);
                    for (int column = 0; column < map.side; ++column) {
                        for (int o = 0; o < 3; ++o)
                            texels.halves.push_back(glm::packHalf1x16(from[column][o] / texels.scale));
                        texels.halves.push_back(0);
                    }
                }
    return texels;
}

}  // namespace

GpuCircle::GpuCircle(const CookedMaterial& cooked, const CircleTables& tables, const glm::dmat3& xyz_to_working)
    : GpuMaterial(cooked, xyz_to_working), size_(tables.size), charts_(chart_count(working_kernel())) {}

void GpuCircle::begin(const Texels& texels) const {
    texels_ = texels;
    if (!texels) log_warning("a grating of representation circle is under a probe without texels: it stays dark");
    const Texels light = texels ? texels : std::make_shared<const lighting::LightSamples>();
    upload_.reset();
    filling_.want(
        texels,
        [light, kernel = working_kernel(), pitch_nm = cooked()->material.grating.pitch_nm, size = size_,
         zero_order = working_zero_order(), cover = cooked()->material.grating.cover](
            const std::stop_token& stop, const Filling::Publish&) -> std::optional<std::shared_ptr<MapTexels>> {
            const CircleMap map = fill_circle_map(*light, kernel, pitch_nm, size, zero_order, cover, stop);
            if (stop.stop_requested()) return std::nullopt;
            return std::make_shared<MapTexels>(in_layout(map));
        });
    ++fills_begun_;
}

void GpuCircle::take_over(const Filling::Change& change) const {
    if (!change.failure.empty()) fail_system("", "a map that cannot be filled: " + change.failure);
    if (change.value) upload_.emplace(*filling_.value());
}

void GpuCircle::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState&) const {
    if (!texels_ || *texels_ != light.texels(light_part())) begin(light.texels(light_part()));
    take_over(object.slices_per_frame >= size_.views ? filling_.wait() : filling_.poll());
    if (!upload_ || !upload_->upload(object.slices_per_frame)) return;
    map_ = upload_->take();
    upload_.reset();
    ++fills_;
}

void GpuCircle::describe(const SurfaceState&, gpu::ProgramDesc& desc) const {
    if (map_)
        describe_map(desc);
    else
        set_shaders(desc, "shaders/pixel_shaded.vert.glsl", "representations/direct/direct.frag.glsl");
}

bool GpuCircle::describe_other(const SurfaceState&, gpu::ProgramDesc& desc) const {
    if (!map_) describe_map(desc);
    return !map_;
}

void GpuCircle::describe_map(gpu::ProgramDesc& desc) const {
    if (cooked()->material.quality.map_at_vertices)
        set_vertex_shader(desc, "representations/circle/circle.vert.glsl");
    else
        set_shaders(desc, "shaders/pixel_shaded.vert.glsl", "representations/circle/circle.frag.glsl");
    desc.defines.push_back({"CHARTS", std::to_string(charts_)});
    desc.defines.push_back({"TERMS", std::to_string(size_.terms)});
    desc.defines.push_back({"SIDE", std::to_string(size_.side)});
    desc.defines.push_back({"VIEWS", std::to_string(size_.views)});
}

void GpuCircle::bind_tables(const gpu::Program& program, const SurfaceState&) const {
    if (map_) map_->bind(program);
}

}  // namespace rowland::diffraction
