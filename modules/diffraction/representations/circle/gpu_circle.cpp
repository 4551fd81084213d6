#include "modules/diffraction/representations/circle/gpu_circle.h"

#include <string>

#include "engine/core/log.h"

namespace rowland::diffraction {

GpuCircle::GpuCircle(const CookedMaterial& cooked, const CircleTables& tables, const glm::dmat3& xyz_to_working)
    : GpuMaterial(cooked, xyz_to_working), size_(tables.size), charts_(chart_count(working_kernel())) {}

void GpuCircle::begin(const std::shared_ptr<const lighting::LightSamples>& texels) const {
    texels_ = texels;
    if (!texels) log_warning("a grating of representation circle is under a probe without texels: it stays dark");
    filling_ = std::make_unique<CircleFilling>(texels ? texels : std::make_shared<const lighting::LightSamples>(),
                                               working_kernel(), cooked()->material.grating.pitch_nm, size_,
                                               working_zero_order(), cooked()->material.grating.cover);
    ++fills_begun_;
}

void GpuCircle::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState&) const {
    if (!texels_ || *texels_ != light.texels(light_part())) begin(light.texels(light_part()));
    if (!filling_) return;
    if (object.slices_per_frame >= size_.views) filling_->wait();
    if (!filling_->upload(object.slices_per_frame)) return;
    map_ = filling_->take();
    filling_.reset();
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
