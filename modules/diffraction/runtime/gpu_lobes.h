#pragma once

#include <span>
#include <vector>

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/key_lights.h"
#include "modules/diffraction/bake/blurred_kernel.h"

namespace rowland::diffraction {

/// The tables of the key lights for one grating (representations/direct/lobe_table.h), one texture layer each:
/// shaders/key_lobes.glsl. They do not depend on the lights' directions.
class GpuLobes {
 public:
    /// Rebuilds the layers if the lights' fluxes or concentrations changed.
    void set(const BlurredKernel& kernel, double pitch_nm, std::span<const lighting::KeyLight> lights);
    void bind(const gpu::Program& program, const KernelUniforms& kernel, double pitch_nm) const;

 private:
    gpu::Texture texture_;
    std::vector<lighting::KeyLight> lights_;
    float scale_ = 1.0F;  ///< of stored values, per unit of the flux' largest component
    double begin_nm_ = 0.0;
    double end_nm_ = 0.0;
};

}  // namespace rowland::diffraction
