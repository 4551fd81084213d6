#include "modules/diffraction/runtime/gpu_kernel.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <span>
#include <vector>

#include "engine/colour/working_space.h"
#include "modules/diffraction/bake/blurred_kernel.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

namespace {

/// From XYZ to the colour space of the kernel's values: groove_lobe.glsl.
glm::dmat3 kernel_space(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working) {
    return std::holds_alternative<PitsLobe>(cooked.material.grating.lobe) ? glm::dmat3(1.0) : xyz_to_working;
}

}  // namespace

GpuKernel::GpuKernel(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working)
    : kernel_(in_space(cooked.kernel, kernel_space(cooked, xyz_to_working))),
      pitch_nm_(cooked.material.grating.pitch_nm),
      lobe_(cooked.material.grating.lobe),
      zero_order_(kernel_space(cooked, xyz_to_working) * cooked.zero_order_xyz),
      working_to_rec709_(glm::inverse(xyz_to_working * colour::rec709_to_xyz())) {}

const GpuKernel::Blurred& GpuKernel::blurred() const {
    if (!blurred_) {
        blurred_.emplace(Blurred{.kernel = blur_for_lights(kernel_, pitch_nm_), .uniforms = {}});
        blurred_->uniforms = kernel_uniforms(kernel_, blurred_->kernel, pitch_nm_);
    }
    return *blurred_;
}

GpuKernel::Smoothed GpuKernel::smooth(std::span<const glm::vec3> light_colours) const {
    const BlurredKernel& kernel = blurred().kernel;
    // fp16 would add an error of 5e-4 to that of the texture unit's 8-bit weights.
    Smoothed smoothed{.texture = gpu::Texture({.kind = gpu::TextureKind::PlaneArray,
                                               .format = gpu::Format::RGBA32F,
                                               .width = kernel.columns,
                                               .height = kernel.levels,
                                               .depth = kFirstColourLayer + static_cast<int>(light_colours.size())},
                                              {.filter = gpu::Filter::Linear}),
                      .colours{light_colours.begin(), light_colours.end()}};
    const auto upload = [&](const glm::vec3& colour, int layer) {
        std::vector<glm::vec4> texels;
        texels.reserve(kernel.values.size());
        for (const glm::mat3& value : kernel.values) texels.emplace_back(value * colour, 0.0F);
        smoothed.texture.upload(std::span<const glm::vec4>(texels), {.layer = layer});
    };
    for (int c = 0; c < 3; ++c) upload(glm::mat3(1.0F)[c], c);
    for (std::size_t i = 0; i < light_colours.size(); ++i)
        upload(light_colours[i], kFirstColourLayer + static_cast<int>(i));
    return smoothed;
}

void GpuKernel::add_defines(gpu::ProgramDesc& desc) const {
    if (zero_order_ != glm::mat3(0.0F)) desc.defines.push_back({"ZERO_ORDER", "1"});
    if (std::holds_alternative<GaussianLobe>(lobe_)) desc.defines.push_back({"LOBE_GAUSSIAN", "1"});
    if (std::holds_alternative<PitsLobe>(lobe_)) desc.defines.push_back({"LOBE_PITS", "1"});
}

void GpuKernel::set_lobe(const gpu::Program& program) const {
    const auto set_gaussian = [&](double sigma, double power) {
        program.set("lobe_gaussian",
                    glm::vec2(glm::dvec2(sigma, power * lobe_density(GaussianLobe{sigma}, 0.0, 550.0))));
    };
    if (const auto* gaussian = std::get_if<GaussianLobe>(&lobe_)) set_gaussian(gaussian->sigma, 1.0);
    if (const auto* pits = std::get_if<PitsLobe>(&lobe_)) {
        set_gaussian(kCoherentSigma, pits->coherent);
        program.set("pit_wavelengths", glm::vec3(pits->length_nm / kPitsWavelengths_nm));
        program.set("incoherent", static_cast<float>(1.0 - pits->coherent));
    }
}

void GpuKernel::bind(const gpu::Program& program, std::span<const lighting::KeyLight> key_lights,
                     std::span<const glm::vec3> light_colours) const {
    if (program.has_uniform("lobe_scale_bias")) {
        lobes_.set(blurred().kernel, pitch_nm_, key_lights);
        lobes_.bind(program, blurred().uniforms, pitch_nm_);
    }
    set_lobe(program);
    if (!program.has_uniform("kernel_scale_bias")) return;
    if (!smoothed_ || !std::ranges::equal(smoothed_->colours, light_colours)) smoothed_ = smooth(light_colours);
    smoothed_->texture.bind(kKernelUnit);
    const KernelUniforms& uniforms = blurred().uniforms;
    program.set("kernel_scale_bias", uniforms.scale_bias);
    program.set("kernel_rows", uniforms.rows);
    program.set("kernel_reach", uniforms.reach);
    program.set("zero_order", zero_order_);
    program.set("working_to_rec709", working_to_rec709_);
}

}  // namespace rowland::diffraction
