#include "modules/diffraction/bake/cube_pyramid.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>

namespace rowland::diffraction {

namespace {

/// The axes of the ellipse with the second moments of a parallelogram, as full widths, the longer first.
struct Ellipse {
    glm::dvec3 major{0.0};
    double major_length = 0.0;
    double minor_length = 0.0;
};

Ellipse ellipse_of(const glm::dvec3& a, const glm::dvec3& b) {
    // Eigenvectors of a aᵀ + b bᵀ lie in the plane of a and b: rotate the pair until it is orthogonal (one Jacobi
    // rotation).
    const double angle = 0.5 * std::atan2(2.0 * glm::dot(a, b), glm::dot(a, a) - glm::dot(b, b));
    const glm::dvec3 first = std::cos(angle) * a + std::sin(angle) * b;
    const glm::dvec3 second = std::cos(angle) * b - std::sin(angle) * a;
    return {first, glm::length(first), glm::length(second)};
}

}  // namespace

CubePyramid::CubePyramid(const lighting::EnvironmentMap& map) : layout_(map.layout) {
    layout_.levels = 1;
    while (layout_.size(layout_.levels - 1) > 1) ++layout_.levels;
    texels_.assign(map.texels.begin(), map.texels.begin() + static_cast<std::ptrdiff_t>(layout_.offset(1)));
    texels_.resize(layout_.offset(layout_.levels));
    for (int level = 1; level < layout_.levels; ++level)
        for (int face = 0; face < 6; ++face)
            for (int row = 0; row < layout_.size(level); ++row)
                for (int column = 0; column < layout_.size(level); ++column) {
                    const auto finer = [&](int i, int j) {
                        return texels_[layout_.index(level - 1, face, 2 * column + i, 2 * row + j)];
                    };
                    texels_[layout_.index(level, face, column, row)] =
                        0.25F * (finer(0, 0) + finer(1, 0) + finer(0, 1) + finer(1, 1));
                }
}

std::span<const glm::vec3> CubePyramid::level(int level) const {
    return std::span(texels_).subspan(layout_.offset(level), layout_.offset(level + 1) - layout_.offset(level));
}

glm::dvec3 CubePyramid::texel(int level, int face, int column, int row) const {
    const int size = layout_.size(level);
    if (column < 0 || row < 0 || column >= size || row >= size) {
        // Over an edge: the neighbour's texel in the direction of this one's centre.
        const lighting::CubePoint over = lighting::cube_point(
            lighting::cube_direction(face, 2.0 * (column + 0.5) / size - 1.0, 2.0 * (row + 0.5) / size - 1.0));
        face = over.face;
        column = std::clamp(static_cast<int>(0.5 * (over.s + 1.0) * size), 0, size - 1);
        row = std::clamp(static_cast<int>(0.5 * (over.t + 1.0) * size), 0, size - 1);
    }
    return glm::dvec3(texels_[layout_.index(level, face, column, row)]);
}

glm::dvec3 CubePyramid::bilinear(int level, const glm::dvec3& direction) const {
    const lighting::CubePoint point = lighting::cube_point(direction);
    const double x = 0.5 * (point.s + 1.0) * layout_.size(level) - 0.5;
    const double y = 0.5 * (point.t + 1.0) * layout_.size(level) - 0.5;
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y));
    const double u = x - column;
    const double v = y - row;
    return (1.0 - v) *
               ((1.0 - u) * texel(level, point.face, column, row) + u * texel(level, point.face, column + 1, row)) +
           v * ((1.0 - u) * texel(level, point.face, column, row + 1) +
                u * texel(level, point.face, column + 1, row + 1));
}

glm::dvec3 CubePyramid::at_level(const glm::dvec3& direction, double level) const {
    const double clamped = std::clamp(level, 0.0, static_cast<double>(layout_.levels - 1));
    const int below = static_cast<int>(clamped);
    const double weight = clamped - below;
    const glm::dvec3 finer = bilinear(below, direction);
    return weight == 0.0 ? finer : (1.0 - weight) * finer + weight * bilinear(below + 1, direction);
}

CubePyramid::Samples CubePyramid::samples(const glm::dvec3& a, const glm::dvec3& b, int most_taps) const {
    const Ellipse ellipse = ellipse_of(a, b);
    const double texel_angle = kCubeFaceAngle / layout_.face_size;
    // Level 0 limits the resolution.
    const double minor = std::max(ellipse.minor_length, texel_angle / kTexelsPerWidth);
    const int count = std::clamp(static_cast<int>(std::ceil(ellipse.major_length / minor - 0.5)), 1, most_taps);
    const double width = std::max(minor, ellipse.major_length / count);
    return {.along = ellipse.major, .count = count, .level = std::log2(width * kTexelsPerWidth / texel_angle)};
}

glm::dvec3 CubePyramid::filtered(const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b,
                                 int most_taps) const {
    const Samples all = samples(a, b, most_taps);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < all.count; ++i) sum += at_level(direction + all.offset(i), all.level);
    return sum / static_cast<double>(all.count);
}

}  // namespace rowland::diffraction
