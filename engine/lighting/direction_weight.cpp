#include "engine/lighting/direction_weight.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/lighting/environment_map.h"

namespace rowland::lighting {

namespace {

/// Cells a side of a cube face, for normals and for directions.
constexpr int kNormalSide = 6;
constexpr int kWeightSide = 32;
constexpr std::size_t kCorners = kWeightSide + 1;

/// A surface without signal counts as one of this fraction of the mean squared signal.
constexpr double kLeastSignal = 4e-4;

struct Facing {
    glm::dvec3 normal;
    double weight;  ///< of max(0, n·s)²
};

double clamped_square(const glm::dvec3& normal, const glm::dvec3& s) {
    const double cosine = std::max(0.0, glm::dot(normal, s));
    return cosine * cosine;
}

std::vector<Facing> facings(std::span<const DirectionWeight::Signal> signals) {
    std::vector<Facing> result;
    std::vector<double> squares;
    double mean = 0.0;
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < kNormalSide; ++row)
            for (int column = 0; column < kNormalSide; ++column) {
                const glm::dvec3 normal = glm::normalize(
                    cube_direction(face, (2 * column + 1.0) / kNormalSide - 1, (2 * row + 1.0) / kNormalSide - 1));
                const double up = 0.5 + 0.5 * normal.y;
                result.push_back({normal, up * up * cube_solid_angle(kNormalSide, column, row)});
                double square = 0.0;
                for (const DirectionWeight::Signal& signal : signals)
                    square += clamped_square(normal, signal.direction) * signal.square;
                squares.push_back(square);
                mean += square / (6 * kNormalSide * kNormalSide);
            }
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double square = std::max(0.0, squares[i]) + kLeastSignal * mean;
        result[i].weight /= square > 0.0 ? square : 1.0;
    }
    return result;
}

}  // namespace

DirectionWeight::DirectionWeight(std::span<const Signal> signals) {
    const std::vector<Facing> all = facings(signals);
    double mean = 0.0;
    for (int face = 0; face < 6; ++face)
        for (std::size_t row = 0; row < kCorners; ++row)
            for (std::size_t column = 0; column < kCorners; ++column) {
                const glm::dvec3 s =
                    glm::normalize(cube_direction(face, 2.0 * static_cast<double>(column) / kWeightSide - 1,
                                                  2.0 * static_cast<double>(row) / kWeightSide - 1));
                double weight = 0.0;
                for (const Facing& facing : all) weight += facing.weight * clamped_square(facing.normal, s);
                roots_.push_back(std::sqrt(weight));
                mean += roots_.back() / (6.0 * kCorners * kCorners);
            }
    for (double& root : roots_) root /= mean;
}

double DirectionWeight::root(const glm::dvec3& direction) const {
    const CubePoint at = cube_point(direction);
    const double x = std::clamp(0.5 * (at.s + 1.0), 0.0, 1.0) * kWeightSide;
    const double y = std::clamp(0.5 * (at.t + 1.0), 0.0, 1.0) * kWeightSide;
    const int column = std::min(static_cast<int>(x), kWeightSide - 1);
    const int row = std::min(static_cast<int>(y), kWeightSide - 1);
    const double* corner =
        &roots_[(static_cast<std::size_t>(at.face) * kCorners + static_cast<std::size_t>(row)) * kCorners +
                static_cast<std::size_t>(column)];
    const double along = x - column;
    return std::lerp(std::lerp(corner[0], corner[1], along), std::lerp(corner[kCorners], corner[kCorners + 1], along),
                     y - row);
}

}  // namespace rowland::lighting
