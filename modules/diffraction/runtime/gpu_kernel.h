#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::diffraction {

/// What shades lights of their own: shaders/direct.glsl.
class GpuKernel {
 public:
    /// `xyz_to_working`: of the engine's lights, which come in the working space.
    GpuKernel(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working);

    void add_defines(gpu::ProgramDesc& desc) const;
    /// Puts the kernel on the GPU when first a program reads it.
    void bind(const gpu::Program& program) const;

 private:
    struct Smoothed {
        gpu::Texture texture;
        glm::vec4 place{0.0F};
    };
    Smoothed smooth() const;
    void set_lobe(const gpu::Program& program) const;

    KernelTable kernel_;
    double pitch_nm_;
    GrooveLobe lobe_;
    glm::mat3 zero_order_;
    glm::mat3 working_to_rec709_;
    mutable std::optional<Smoothed> smoothed_;
};

}  // namespace rowland::diffraction
