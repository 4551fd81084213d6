#pragma once

#include <glm/mat3x3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/key_lights.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/bake/blurred_kernel.h"
#include "modules/diffraction/runtime/gpu_lobes.h"

namespace rowland::diffraction {

/// The kernel for analytic lights and key lights: shaders/direct.glsl.
class GpuKernel {
 public:
    /// `xyz_to_working`: of the engine's lights, which come in the working space.
    GpuKernel(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working);

    void add_defines(gpu::ProgramDesc& desc) const;
    /// Uploads the kernel when a program first reads it, and the key lights' tables when the lights change.
    /// `light_colours`: see SurfaceLight.
    void bind(const gpu::Program& program, std::span<const lighting::KeyLight> key_lights,
              std::span<const glm::vec3> light_colours) const;

 private:
    struct Blurred {
        BlurredKernel kernel;
        KernelUniforms uniforms;
    };
    struct Smoothed {
        gpu::Texture texture;
        std::vector<glm::vec3> colours;  ///< of its layers from the fourth on
    };
    const Blurred& blurred() const;
    Smoothed smooth(std::span<const glm::vec3> light_colours) const;
    void set_lobe(const gpu::Program& program) const;

    KernelTable kernel_;
    double pitch_nm_;
    GrooveLobe lobe_;
    glm::mat3 zero_order_;
    glm::mat3 working_to_rec709_;
    mutable std::optional<Blurred> blurred_;
    mutable std::optional<Smoothed> smoothed_;
    mutable GpuLobes lobes_;
};

}  // namespace rowland::diffraction
