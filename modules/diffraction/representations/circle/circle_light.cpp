#include "modules/diffraction/representations/circle/circle_light.h"

#include <cstddef>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "engine/lighting/environment_map.h"

namespace rowland::diffraction {

namespace {

using lighting::CubeCell;

constexpr int kCellParts = 4;      ///< of a cell's side
constexpr int kPartsOfFace = 256;  ///< parts of a face's side

/// A cell's light spreads by weight · variance of direction. Above this fraction of all weight the cell is divided. In
/// a cell of uniform light it is 5e-5 of the cell's weight, so at most 1700 of the 25 000 cells are divided.
constexpr double kBrightSpread = 3e-8;

/// A part is so small that the length of Σ weight · direction is its weight.
double weight_of(const CubeCell& part) {
    return glm::length(part.direction);
}

void add_cell(std::span<const CubeCell> parts, int face, int row, int column, double largest_spread,
              lighting::LightSamples& samples) {
    const lighting::CubeLayout layout{kPartsOfFace, 1};
    std::vector<CubeCell> cell;
    CubeCell sum;
    double weight = 0.0;
    for (int i = 0; i < kCellParts * kCellParts; ++i) {
        const CubeCell& part =
            parts[layout.index(0, face, kCellParts * column + i % kCellParts, kCellParts * row + i / kCellParts)];
        cell.push_back(part);
        sum.flux += part.flux;
        sum.direction += part.direction;
        weight += weight_of(part);
    }
    if (weight - glm::length(sum.direction) <= largest_spread) cell = {sum};
    for (const CubeCell& part : cell)
        if (part.direction != glm::dvec3(0.0)) samples.push_back(glm::normalize(part.direction), part.flux);
}

}  // namespace

lighting::LightSamples circle_light(const lighting::LightSamples& texels) {
    const std::vector<CubeCell> parts = lighting::gather_cells(texels, kPartsOfFace);
    double weight = 0.0;
    for (const CubeCell& part : parts) weight += weight_of(part);
    lighting::LightSamples samples;
    for (int face = 0; face < 6; ++face)
        for (int row = 0; row < kPartsOfFace / kCellParts; ++row)
            for (int column = 0; column < kPartsOfFace / kCellParts; ++column)
                add_cell(parts, face, row, column, kBrightSpread * weight, samples);
    return samples;
}

}  // namespace rowland::diffraction
