#include "modules/diffraction/runtime/gpu_circle.h"

#include <algorithm>
#include <string>
#include <vector>

#include "engine/core/log.h"

namespace rowland::diffraction {

namespace {

/// Charts side by side and terms below each other, for one volume texture.
std::vector<glm::vec3> side_by_side(const CircleMap& map) {
    std::vector<glm::vec3> texels;
    texels.reserve(map.xyz.size());
    for (int view = 0; view < map.views; ++view)
        for (int term = 0; term < map.terms; ++term)
            for (int row = 0; row < map.side; ++row)
                for (int chart = 0; chart < map.charts; ++chart) {
                    const auto begin =
                        map.xyz.begin() + static_cast<std::ptrdiff_t>(map.index(chart, term, view, row, 0));
                    texels.insert(texels.end(), begin, begin + map.side);
                }
    return texels;
}

}  // namespace

GpuCircle::GpuCircle(const CookedMaterial& cooked, const CircleTables& tables, const glm::dmat3& xyz_to_working)
    : GpuMaterial(cooked, xyz_to_working),
      size_(tables.size),
      kernel_(cooked.kernel),
      pitch_nm_(cooked.material.grating.pitch_nm),
      zero_order_xyz_(cooked.zero_order_xyz) {}

void GpuCircle::update(const SurfaceObject&, SurfaceLight& light, SurfaceState&) const {
    if (map_ && texels_ == light.texels()) return;
    texels_ = light.texels();
    if (!texels_) log_warning("a grating of representation circle is under a probe without texels: it stays dark");
    const CircleMap map =
        fill_circle_map(texels_ ? *texels_ : lighting::LightTexels(), kernel_, pitch_nm_, size_, zero_order_xyz_);
    charts_ = map.charts;
    map_.emplace(side_by_side(map),
                 gpu::TextureDesc{.kind = gpu::TextureKind::Volume,
                                  .width = map.side * map.charts,
                                  .height = map.side * map.terms,
                                  .depth = map.views},
                 gpu::Sampling{.filter = gpu::Filter::Linear});
    ++fills_;
}

void GpuCircle::describe(const SurfaceState&, gpu::ProgramDesc& desc) const {
    set_shaders(desc, "pixel_shaded.vert.glsl", "circle.frag.glsl");
    desc.defines.push_back({"CHARTS", std::to_string(charts_)});
    desc.defines.push_back({"TERMS", std::to_string(size_.terms)});
}

void GpuCircle::bind_tables(const gpu::Program& program, const SurfaceState&) const {
    map_->bind(program);
}

}  // namespace rowland::diffraction
