#include "modules/diffraction/runtime/gpu_spikes.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/colour/spectrum.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/representations/spikes/spikes.h"
#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/vertex_light.h"

namespace rowland::diffraction {

VertexShaded::VertexShaded(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working, int bands, GpuTable table,
                           const char* vertex_shader)
    : GpuMaterial(cooked, xyz_to_working), bands_(bands), table_(std::move(table)), vertex_shader_(vertex_shader) {}

void VertexShaded::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    if (!object.changed) return;
    require_vertex_light(object, {.texels = static_cast<std::size_t>(math::sh_count(bands_))});
    const std::vector<float> rotated =
        rotate_to_vertices(harmonics(light, bands_), object.mesh, object.object_to_world, object.groove_rotation);
    state.vertex_light.write_values(std::span<const float>(rotated));
}

void VertexShaded::describe(const SurfaceState&, gpu::ProgramDesc& desc) const {
    set_vertex_shader(desc, vertex_shader_);
    desc.defines.push_back({"BANDS", std::to_string(bands_)});
    table_.add_defines(desc);
}

void VertexShaded::bind_tables(const gpu::Program&, const SurfaceState& state) const {
    table_.bind();
    state.vertex_light.bind_texels(kVertexLightUnit);
}

namespace {

/// For each of the light's colours, one texel per nanometre: XYZ of a spike there under light of that colour.
gpu::Texture make_wavelengths() {
    constexpr int kCount = colour::kVisibleMax - colour::kVisibleMin + 1;
    std::vector<glm::vec4> texels;
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < kCount; ++i) texels.emplace_back(glm::vec3(spike_colour(colour::kVisibleMin + i)[c]), 0.0F);
    gpu::Texture texture({.kind = gpu::TextureKind::Line, .format = gpu::Format::RGBA32F, .width = 3 * kCount});
    texture.upload(std::span<const glm::vec4>(texels));
    return texture;
}

}  // namespace

GpuSpikes::GpuSpikes(const CookedMaterial& cooked, const SpikeTable& table, const glm::dmat3& xyz_to_working)
    : VertexShaded(cooked, xyz_to_working, table.bands, GpuTable(table, table.grid()),
                   "representations/spikes/spikes.glsl"),
      spikes_(table.spikes),
      wavelengths_(make_wavelengths()) {}

void GpuSpikes::describe(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    VertexShaded::describe(state, desc);
    desc.defines.push_back({"SPIKES", std::to_string(spikes_)});
}

void GpuSpikes::bind_tables(const gpu::Program& program, const SurfaceState& state) const {
    VertexShaded::bind_tables(program, state);
    wavelengths_.bind(kWavelengthTableUnit);
}

}  // namespace rowland::diffraction
