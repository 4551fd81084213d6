#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/lighting/environment_map.h"

namespace rowland::diffraction {

/// Texels per width of a box filter, for equal blur: trilinear look-ups in box-filtered texels blur by a standard
/// deviation of half a texel, a box by 1/√12 of its width.
inline constexpr double kTexelsPerWidth = 0.57735026918962576451;

/// Mean side of a texel of a face with one texel, in radians: √(4π/6).
inline constexpr double kCubeFaceAngle = 1.44720250911653531871;

/// A light probe as a cube map with box-filtered levels: each texel is the mean of four of the level before. Look-ups
/// equal the shader's.
class CubePyramid {
 public:
    /// From level 0 of `map`.
    explicit CubePyramid(const lighting::EnvironmentMap& map);

    /// Trilinear and seamless, at a level in [0, levels − 1].
    glm::dvec3 at_level(const glm::dvec3& direction, double level) const;

    /// The samples that filter a footprint: so many, evenly along a vector about its middle, all at one level.
    struct Samples {
        glm::dvec3 along{0.0};
        int count = 1;
        double level = 0.0;

        glm::dvec3 offset(int i) const { return ((i + 0.5) / count - 0.5) * along; }
    };
    /// Of the parallelogram that `a` and `b` span: at the level that matches its shorter side, along the longer.
    Samples samples(const glm::dvec3& a, const glm::dvec3& b, int most_taps) const;

    /// Mean radiance over that parallelogram about the unit vector `direction`, all in world axes.
    glm::dvec3 filtered(const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b, int most_taps) const;

    const lighting::CubeLayout& layout() const { return layout_; }
    /// A level's texels: faces, rows, columns.
    std::span<const glm::vec3> level(int level) const;

 private:
    glm::dvec3 bilinear(int level, const glm::dvec3& direction) const;
    glm::dvec3 texel(int level, int face, int column, int row) const;

    lighting::CubeLayout layout_;
    std::vector<glm::vec3> texels_;
};

}  // namespace rowland::diffraction
