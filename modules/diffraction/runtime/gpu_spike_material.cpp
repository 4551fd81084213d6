#include "modules/diffraction/runtime/gpu_spike_material.h"

#include <vector>

#include "engine/colour/light_spectra.h"
#include "engine/colour/observer.h"
#include "engine/colour/sampled_spectrum.h"
#include "modules/diffraction/asset/layer_weights.h"
#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

namespace {

gpu::Texture make_table(const SpikeTable& table) {
    const gpu::Format format = table.storage == Storage::Half ? gpu::Format::RGBA16F : gpu::Format::RGBA16;
    gpu::Texture texture({.kind = gpu::TextureKind::PlaneArray,
                          .format = format,
                          .width = table.phi_nodes,
                          .height = table.theta_nodes,
                          .depth = table.layers()},
                         {.filter = gpu::Filter::Linear, .wrap_s = gpu::Wrap::Repeat});
    texture.upload(std::span<const std::uint16_t>(table.texels), {.layers = table.layers()});
    return texture;
}

std::vector<glm::vec4> ranges(const SpikeTable& table) {
    std::vector<glm::vec4> result;
    for (std::size_t layer = 0; layer < table.scale.size(); ++layer) {
        result.push_back(table.scale[layer]);
        result.push_back(table.bias[layer]);
    }
    return result;
}

/// Row c, one texel a nanometre: XYZ of E_c(λ).
gpu::Texture make_wavelengths() {
    constexpr int kCount = colour::kVisibleMax - colour::kVisibleMin + 1;
    const colour::LightSpectra spectra;
    std::vector<glm::vec4> texels;
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < kCount; ++i) {
            const double wavelength_nm = colour::kVisibleMin + i;
            texels.emplace_back(glm::vec3(colour::cie_xyz(wavelength_nm) * spectra(wavelength_nm)[c]), 0.0F);
        }
    gpu::Texture texture({.format = gpu::Format::RGBA32F, .width = kCount, .height = 3});
    texture.upload(std::span<const glm::vec4>(texels));
    return texture;
}

}  // namespace

GpuSpikeMaterial::GpuSpikeMaterial(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working)
    : bands_(cooked.table.bands),
      spikes_(cooked.table.spikes),
      base_{.base_colour = cooked.material.base.colour, .metallic = 0.0F, .roughness = cooked.material.base.roughness},
      table_(make_table(cooked.table)),
      ranges_(gpu::Buffer::of(std::span<const glm::vec4>(ranges(cooked.table)))),
      wavelengths_(make_wavelengths()) {
    const LayerWeights weights = layer_weights(cooked.material.grating);
    mirror_weight_ = glm::vec3(xyz_to_working * weights.mirror);
    base_weight_ = glm::vec3(xyz_to_working * weights.base);
}

void GpuSpikeMaterial::bind(const gpu::Program& program) const {
    table_.bind(kSpikeTableUnit);
    wavelengths_.bind(kWavelengthTableUnit);
    ranges_.bind_storage(kTableRangeBinding);
    program.set("mirror_weight", mirror_weight_);
    program.set("base_weight", base_weight_);
}

}  // namespace rowland::diffraction
