#pragma once

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/environment_map.h"

namespace rowland::diffraction {

/// A probe's radiance on the GPU with the box-filtered levels of CubePyramid: radiance_cube.glsl.
class RadianceCube {
 public:
    /// `map`: level 0, at least.
    explicit RadianceCube(const lighting::PackedEnvironmentMap& map);

    void bind(const gpu::Program& program) const;

 private:
    gpu::Texture texture_;
    float scale_;
};

}  // namespace rowland::diffraction
