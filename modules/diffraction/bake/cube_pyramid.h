#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/lighting/environment_map.h"

namespace rowland::diffraction {

/// A light probe as a cube map with plain levels, each the mean of four texels of the one before: what
/// glGenerateTextureMipmap() makes of the prefiltered map's level 0, read as a shader reads it.
class CubePyramid {
 public:
    /// From level 0 of `map`.
    explicit CubePyramid(const lighting::EnvironmentMap& map);

    /// Trilinear and seamless, at a level in [0, levels − 1].
    glm::dvec3 at_level(const glm::dvec3& direction, double level) const;

    /// Mean radiance over the parallelogram that `a` and `b` span about the unit vector `direction`, all in world axes:
    /// at the level of the shorter side's texels, up to `most_taps` places along the longer.
    glm::dvec3 filtered(const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b, int most_taps) const;

    const lighting::CubeLayout& layout() const { return layout_; }

 private:
    glm::dvec3 bilinear(int level, const glm::dvec3& direction) const;
    glm::dvec3 texel(int level, int face, int column, int row) const;

    lighting::CubeLayout layout_;
    std::vector<glm::vec3> texels_;
};

}  // namespace rowland::diffraction
