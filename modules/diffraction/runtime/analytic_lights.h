#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/key_lights.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/bake/diffraction_pattern.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/runtime/key_lobe.h"

namespace rowland::diffraction {

/// The tables of the key lights for one grating (representations/direct/lobe_table.h), one texture layer each:
/// shaders/key_light_tables.glsl. They do not depend on the lights' directions.
class GpuLobes {
 public:
    /// `lights`: at least one.
    GpuLobes(const BlurredKernel& kernel, std::span<const lighting::KeyLight> lights);
    /// Whether the tables are those of `lights`, whatever their directions.
    bool are_of(std::span<const lighting::KeyLight> lights) const { return same_lobes(lights, lights_); }
    void bind(const gpu::Program& program, const KernelUniforms& kernel, double pitch_nm) const;

 private:
    gpu::Texture texture_;
    std::vector<lighting::KeyLight> lights_;
    float scale_ = 1.0F;  ///< of stored values, per unit of the flux' largest component
    double begin_nm_ = 0.0;
    double end_nm_ = 0.0;
};

/// The kernel for analytic lights and key lights: shaders/kernel.glsl.
class GpuKernel {
 public:
    /// `xyz_to_working`: to the working space, in which the engine gives its lights.
    GpuKernel(std::shared_ptr<const CookedMaterial> cooked, const glm::dmat3& xyz_to_working);

    bool has_zero_order() const { return zero_order_ != glm::mat3(0.0F); }
    void add_defines(gpu::ProgramDesc& desc) const;
    /// Uploads the kernel when a program first reads it, and the key lights' tables when the lights change.
    /// `light_colours`: see SurfaceLight; `key_windows`: the program shades key lights by key_light_windows.glsl.
    void bind(const gpu::Program& program, std::span<const lighting::KeyLight> key_lights,
              std::span<const glm::vec3> light_colours, bool key_windows) const;

 private:
    /// The kernel smoothed for lights.
    struct Smoothed {
        gpu::Texture texture;
        int first_layer = 0;  ///< of the layers that kernel.glsl numbers, the one that the texture begins with
        std::vector<glm::vec3> colours;  ///< of layers kFirstColourLayer and after
    };
    BlurredKernel blurred() const;
    Smoothed smooth(std::span<const glm::vec3> light_colours, bool key_windows) const;
    void set_lobe(const gpu::Program& program) const;

    std::shared_ptr<const CookedMaterial> cooked_;
    glm::dmat3 xyz_to_kernel_;  ///< the colour space of the kernel's values: kernel.glsl
    glm::mat3 zero_order_;
    glm::mat3 working_to_rec709_;
    BlurLayout layout_;
    KernelUniforms uniforms_;
    mutable std::optional<BlurredKernel> blurred_;  ///< once there are key lights, or colours have changed
    mutable std::optional<Smoothed> smoothed_;
    mutable std::vector<GpuLobes> lobes_;  ///< of several probes, the last used first
};

/// A lattice's diffraction pattern for analytic lights and key lights: shaders/pattern.glsl.
class GpuPattern {
 public:
    /// `xyz_to_working`: to the working space, in which the engine gives its lights.
    GpuPattern(const Material& material, const glm::dmat3& xyz_to_working);

    /// Computes and uploads pictures when a program first reads them, and when the lights' colours or the key lights
    /// change other than in direction. `light_colours`: see SurfaceLight.
    void bind(const gpu::Program& program, std::span<const lighting::KeyLight> key_lights,
              std::span<const glm::vec3> light_colours) const;

 private:
    struct Lobes {
        std::vector<lighting::KeyLight> lights;
        gpu::Texture texture;  ///< a layer for each
        glm::vec4 scale{0.0F};
    };

    void upload_colours(std::span<const glm::vec3> light_colours) const;
    Lobes lobes_of(std::span<const lighting::KeyLight> key_lights) const;

    Grating grating_;
    colour::Illuminant illuminant_;
    glm::dmat3 xyz_to_working_;
    mutable std::optional<PatternPicture> picture_;  ///< in the working space, its largest component 1
    mutable float largest_ = 1.0F;
    mutable std::optional<gpu::Texture> texture_;
    mutable std::vector<glm::vec3> colours_;  ///< of its layers
    mutable std::vector<Lobes> lobes_;        ///< of several probes, the last used first
};

}  // namespace rowland::diffraction
