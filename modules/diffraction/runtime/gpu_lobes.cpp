#include "modules/diffraction/runtime/gpu_lobes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <glm/vec4.hpp>

#include "engine/core/parallel.h"
#include "modules/diffraction/representations/direct/lobe_table.h"
#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/key_lobe.h"

namespace rowland::diffraction {

void GpuLobes::set(const BlurredKernel& kernel, double pitch_nm, std::span<const lighting::KeyLight> lights) {
    if (lights.empty() || same_lobes(lights, lights_)) return;
    lights_.assign(lights.begin(), lights.end());
    begin_nm_ = kernel.begin_nm;
    end_nm_ = kernel.end_nm;
    const int columns = static_cast<int>(std::bit_floor(static_cast<unsigned>(kernel.columns)));
    std::vector<LobeTable> tables(lights_.size());
    parallel_for(lights_.size(),
                 [&](std::size_t i) { tables[i] = make_lobe_table(kernel, pitch_nm, lights_[i], columns); });
    // Stored as fp16: each layer is divided by its light's flux, and all by the largest component.
    std::vector<float> inverse_flux;
    float largest = 1e-30F;
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const auto flux = static_cast<float>(glm::compMax(lights_[i].flux));
        inverse_flux.push_back(flux > 0.0F ? 1.0F / flux : 0.0F);
        for (const glm::vec3& value : tables[i].values)
            largest = std::max(largest, inverse_flux[i] * glm::compMax(glm::abs(value)));
    }
    texture_ = gpu::Texture({.kind = gpu::TextureKind::PlaneArray,
                             .format = gpu::Format::RGBA16F,
                             .width = columns,
                             .height = tables[0].rows,
                             .depth = static_cast<int>(tables.size())},
                            {.filter = gpu::Filter::Linear});
    for (std::size_t i = 0; i < tables.size(); ++i) {
        for (glm::vec3& value : tables[i].values) value *= inverse_flux[i] / largest;
        texture_.upload(std::span<const glm::vec3>(tables[i].values), {.layer = static_cast<int>(i)});
    }
    scale_ = largest;
}

void GpuLobes::bind(const gpu::Program& program, const KernelUniforms& kernel, double pitch_nm) const {
    if (lights_.empty() || !program.has_uniform("lobe_scale_bias")) return;
    texture_.bind(kLobeUnit);
    const double extent_nm = end_nm_ - begin_nm_;
    // Five deviations of the kernel's own smoothing.
    program.set("lobe_reach", kernel.reach + glm::vec2(0.0F, 5.0F * kernel.scale_bias.z));
    program.set("lobe_scale_bias", glm::vec3(glm::dvec3(pitch_nm / extent_nm, -begin_nm_ / extent_nm, double{scale_})));
}

}  // namespace rowland::diffraction
