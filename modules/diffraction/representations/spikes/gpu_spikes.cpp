#include "modules/diffraction/representations/spikes/gpu_spikes.h"

#include <span>
#include <string>
#include <vector>

#include "engine/colour/sampled_spectrum.h"
#include "modules/diffraction/representations/spikes/spikes.h"
#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

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
                   "representations/spikes/spikes.vert.glsl"),
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
