#include "engine/lighting/packed_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/environment_map.h"
#include "engine/lighting/scaled_halves.h"

namespace rowland::lighting {

namespace {

/// Cube faces that lobes are sampled on, and the longest side of a cell.
constexpr int kLobeFace = 128;
constexpr double kLobeCellSide = 2.0 / kLobeFace;

/// Steps of a position along a cell's side.
constexpr double kPositions = 256.0;

struct Cell {
    int face = 0;
    int row = 0;
    int column = 0;
};

Cell cell_at(std::size_t index, int face_size) {
    const auto side = static_cast<std::size_t>(face_size);
    return {static_cast<int>(index / (side * side)), static_cast<int>(index / side % side),
            static_cast<int>(index % side)};
}

/// Direction through a position in [0, 1]² of a cell.
glm::dvec3 direction_in(const Cell& cell, int face_size, double s, double t) {
    return glm::normalize(
        cube_direction(cell.face, 2.0 * (cell.column + s) / face_size - 1.0, 2.0 * (cell.row + t) / face_size - 1.0));
}

std::uint8_t position_byte(double position) {
    return static_cast<std::uint8_t>(std::clamp(std::floor(position * kPositions), 0.0, kPositions - 1.0));
}

LightSamples stored_samples(const PackedLight& light) {
    const std::size_t count = light.halves.size() / 3;
    LightSamples samples;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 stored(from_half(light.halves[i]), from_half(light.halves[count + i]),
                                from_half(light.halves[2 * count + i]));
        if (stored == glm::dvec3(0.0)) continue;
        samples.push_back(
            direction_in(cell_at(i, light.face_size), light.face_size, (light.positions[i] + 0.5) / kPositions,
                         (light.positions[count + i] + 0.5) / kPositions),
            static_cast<double>(light.scale) * stored);
    }
    return samples;
}

/// Appends the lobes' samples with negative flux, in the cells of a fixed cube: at the stored samples' directions they
/// would move the lobes.
void subtract(std::span<const KeyLight> keys, LightSamples& samples) {
    constexpr auto kSide = static_cast<std::size_t>(kLobeFace);
    std::vector<glm::dvec3> directions(6 * kSide * kSide);
    std::vector<double> solid_angles(kSide * kSide);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const Cell cell = cell_at(i, kLobeFace);
        directions[i] = direction_in(cell, kLobeFace, 0.5, 0.5);
        if (cell.face == 0) solid_angles[i] = cube_solid_angle(kLobeFace, cell.column, cell.row);
    }
    std::vector<LobeFractions> lobes(keys.size());
    parallel_for(keys.size(), [&](std::size_t k) {
        if (!is_resolved(keys[k], kLobeCellSide)) return;
        lobes[k] = lobe_fractions(
            keys[k], directions.size(), [&](std::size_t i) { return directions[i]; },
            [&](std::size_t i) { return solid_angles[i % solid_angles.size()]; });
    });
    std::vector<glm::dvec3> flux(directions.size(), glm::dvec3(0.0));
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (!is_resolved(keys[k], kLobeCellSide)) subtract_narrow_lobe(keys[k], samples);
        for (std::size_t j = 0; j < lobes[k].indices.size(); ++j)
            flux[lobes[k].indices[j]] += lobes[k].fractions[j] * keys[k].flux;
    }
    for (std::size_t i = 0; i < flux.size(); ++i)
        if (flux[i] != glm::dvec3(0.0)) samples.push_back(directions[i], -flux[i]);
}

}  // namespace

PackedLight pack(std::span<const CubeCell> cells, int face_size) {
    ROWLAND_CHECK_OP(face_size, >=, 1);
    ROWLAND_CHECK_OP(face_size, <=, kMaximumLightFace);
    ROWLAND_CHECK_OP(cells.size(), ==, CubeLayout({face_size, 1}).offset(1));
    double largest = 0.0;
    for (const CubeCell& cell : cells)
        for (int c = 0; c < 3; ++c) {
            ROWLAND_CHECK(std::isfinite(cell.flux[c]) && cell.flux[c] >= 0.0,
                          "the flux of a probe is finite and not negative");
            largest = std::max(largest, cell.flux[c]);
        }
    PackedLight packed;
    packed.face_size = face_size;
    packed.scale = half_scale(largest);
    packed.halves.resize(3 * cells.size());
    packed.positions.resize(2 * cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            packed.halves[c * cells.size() + i] = to_half(cells[i].flux[static_cast<int>(c)], packed.scale);
        const double weight = cells[i].flux.x + cells[i].flux.y + cells[i].flux.z;
        const glm::dvec2 position = weight > 0.0 ? cells[i].position / weight : glm::dvec2(0.5);
        packed.positions[i] = position_byte(position.x);
        packed.positions[cells.size() + i] = position_byte(position.y);
    }
    return packed;
}

PackedLight pack(const LightSamples& texels, int face_size) {
    return pack(gather_cells(texels, face_size), face_size);
}

LightSamples unpack(const PackedLight& light, std::span<const KeyLight> keys) {
    ROWLAND_CHECK_OP(light.halves.size() * 2, ==, light.positions.size() * 3);
    LightSamples samples = stored_samples(light);
    if (!keys.empty()) subtract(keys, samples);
    return samples;
}

}  // namespace rowland::lighting
