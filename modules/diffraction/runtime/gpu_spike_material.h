#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "engine/gpu/buffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "engine/render/material.h"
#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::diffraction {

/// A cooked material on the GPU: the spike table, its ranges and the wavelengths' colours.
class GpuSpikeMaterial {
 public:
    /// `xyz_to_working` as the renderer's.
    GpuSpikeMaterial(const CookedMaterial& cooked, const glm::dmat3& xyz_to_working);

    int bands() const { return bands_; }
    int spikes() const { return spikes_; }
    /// The engine's surface under the grating.
    const render::StandardMaterial& base() const { return base_; }

    void bind(const gpu::Program& program) const;

 private:
    int bands_;
    int spikes_;
    render::StandardMaterial base_;
    glm::vec3 mirror_weight_{0.0F};
    glm::vec3 base_weight_{1.0F};
    gpu::Texture table_;
    gpu::Buffer ranges_;
    gpu::Texture wavelengths_;
};

}  // namespace rowland::diffraction
