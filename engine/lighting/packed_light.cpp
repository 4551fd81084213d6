#include "engine/lighting/packed_light.h"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/environment_map.h"

namespace rowland::lighting {

namespace {

/// κ(1 − cos) beyond which a lobe's density, at most exp(−this) of its peak, is left out.
constexpr double kTakenOutReach = 16.0;

/// Cube faces that lobes are cut into: texels of at most 0.016 rad, less than the deviation of the narrowest lobe that
/// is fitted (0.018) and of what a grating's colours resolve.
constexpr int kLobeFace = 128;

/// Steps of a light's place along a texel's side.
constexpr double kPlaces = 256.0;

/// Where on the cube a texel lies.
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

/// Direction through a point of a texel, each share in [0, 1] of its side.
glm::dvec3 direction_in(const Cell& cell, int face_size, double s_share, double t_share) {
    return glm::normalize(cube_direction(cell.face, 2.0 * (cell.column + s_share) / face_size - 1.0,
                                         2.0 * (cell.row + t_share) / face_size - 1.0));
}

/// What a texel of the cube receives.
struct Gathered {
    glm::dvec3 flux{0.0};
    glm::dvec2 place{0.0};  ///< shares of the sides, weighted by flux
};

std::vector<Gathered> gather(const LightTexels& texels, int face_size) {
    const auto side = static_cast<std::size_t>(face_size);
    std::vector<Gathered> cells(6 * side * side);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const glm::dvec3 flux(texels.red[i], texels.green[i], texels.blue[i]);
        const double magnitude = flux.x + flux.y + flux.z;
        if (magnitude == 0.0) continue;
        const CubePoint point = cube_point({texels.x[i], texels.y[i], texels.z[i]});
        const glm::dvec2 at = 0.5 * face_size * glm::dvec2(point.s + 1.0, point.t + 1.0);
        const glm::dvec2 corner = glm::clamp(glm::floor(at), glm::dvec2(0.0), glm::dvec2(face_size - 1.0));
        Gathered& cell =
            cells[(static_cast<std::size_t>(point.face) * side + static_cast<std::size_t>(corner.y)) * side +
                  static_cast<std::size_t>(corner.x)];
        cell.flux += flux;
        cell.place += magnitude * (at - corner);
    }
    return cells;
}

std::uint8_t place_byte(double share) {
    return static_cast<std::uint8_t>(std::clamp(std::floor(share * kPlaces), 0.0, kPlaces - 1.0));
}

float unpacked(std::uint16_t bits) {
    half value;
    value.setBits(bits);
    return value;
}

void append(LightTexels& texels, const glm::dvec3& direction, const glm::dvec3& flux) {
    const glm::vec3 s(direction);
    const glm::vec3 rgb(flux);
    texels.x.push_back(s.x);
    texels.y.push_back(s.y);
    texels.z.push_back(s.z);
    texels.red.push_back(rgb.x);
    texels.green.push_back(rgb.y);
    texels.blue.push_back(rgb.z);
}

LightTexels stored_lights(const PackedLight& light) {
    const std::size_t count = light.halves.size() / 3;
    LightTexels texels;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 stored(unpacked(light.halves[i]), unpacked(light.halves[count + i]),
                                unpacked(light.halves[2 * count + i]));
        if (stored == glm::dvec3(0.0)) continue;
        append(texels,
               direction_in(cell_at(i, light.face_size), light.face_size, (light.places[i] + 0.5) / kPlaces,
                            (light.places[count + i] + 0.5) / kPlaces),
               static_cast<double>(light.scale) * stored);
    }
    return texels;
}

/// The texels of a cube that lobes are cut into: their centres and solid angles.
struct Grid {
    std::vector<glm::dvec3> directions;
    std::vector<double> solid_angles;
};

Grid make_grid(int face_size) {
    const auto side = static_cast<std::size_t>(face_size);
    Grid grid{std::vector<glm::dvec3>(6 * side * side), std::vector<double>(side * side)};
    for (std::size_t i = 0; i < grid.directions.size(); ++i) {
        const Cell cell = cell_at(i, face_size);
        grid.directions[i] = direction_in(cell, face_size, 0.5, 0.5);
        if (cell.face == 0) grid.solid_angles[i] = cube_solid_angle(face_size, cell.column, cell.row);
    }
    return grid;
}

/// The shares of a lobe's flux in the texels it reaches; they sum to 1. None for a lobe that falls between the centres.
struct TakenOutShares {
    std::vector<std::size_t> texels;
    std::vector<double> shares;
};

TakenOutShares taken_out_shares(const KeyLight& key, const Grid& grid) {
    TakenOutShares result;
    double sum = 0.0;
    const double nearest = 1.0 - kTakenOutReach / key.concentration;
    for (std::size_t i = 0; i < grid.directions.size(); ++i) {
        if (glm::dot(grid.directions[i], key.direction) < nearest) continue;
        result.texels.push_back(i);
        result.shares.push_back(lobe_density(key, grid.directions[i]) *
                                grid.solid_angles[i % grid.solid_angles.size()]);
        sum += result.shares.back();
    }
    if (!(std::abs(sum - 1.0) < 0.01)) return {};
    for (double& share : result.shares) share /= sum;
    return result;
}

/// Adds lights of negative flux, in places of their own: at the stored lights' places they would move the lobes.
void take_out(std::span<const KeyLight> keys, LightTexels& texels) {
    const Grid grid = make_grid(kLobeFace);
    std::vector<TakenOutShares> lobes(keys.size());
    parallel_for(keys.size(), [&](std::size_t k) { lobes[k] = taken_out_shares(keys[k], grid); });
    std::vector<glm::dvec3> taken(grid.directions.size(), glm::dvec3(0.0));
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (lobes[k].texels.empty()) append(texels, keys[k].direction, -keys[k].flux);
        for (std::size_t j = 0; j < lobes[k].texels.size(); ++j)
            taken[lobes[k].texels[j]] += lobes[k].shares[j] * keys[k].flux;
    }
    for (std::size_t i = 0; i < taken.size(); ++i)
        if (taken[i] != glm::dvec3(0.0)) append(texels, grid.directions[i], -taken[i]);
}

}  // namespace

PackedLight pack(const LightTexels& texels, int face_size) {
    ROWLAND_CHECK_OP(face_size, >=, 1);
    ROWLAND_CHECK_OP(face_size, <=, kMaximumLightFace);
    const std::vector<Gathered> cells = gather(texels, face_size);
    double largest = 0.0;
    for (const Gathered& cell : cells)
        for (int c = 0; c < 3; ++c) {
            ROWLAND_CHECK(std::isfinite(cell.flux[c]) && cell.flux[c] >= 0.0, "a probe sends finite light");
            largest = std::max(largest, cell.flux[c]);
        }
    PackedLight packed;
    packed.face_size = face_size;
    // The largest value lands in [16384, 32768): as far from underflow as a power of two gets it without overflow.
    if (largest > 0.0) packed.scale = std::ldexp(1.0F, std::max(std::ilogb(largest) + 1 - 15, -120));
    packed.halves.resize(3 * cells.size());
    packed.places.resize(2 * cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const glm::dvec3& flux = cells[i].flux;
        const double magnitude = flux.x + flux.y + flux.z;
        const glm::dvec2 place = magnitude > 0.0 ? cells[i].place / magnitude : glm::dvec2(0.5);
        for (std::size_t c = 0; c < 3; ++c)
            packed.halves[c * cells.size() + i] =
                half(static_cast<float>(flux[static_cast<int>(c)] / static_cast<double>(packed.scale))).bits();
        packed.places[i] = place_byte(place.x);
        packed.places[cells.size() + i] = place_byte(place.y);
    }
    return packed;
}

LightTexels unpack(const PackedLight& light, std::span<const KeyLight> keys) {
    ROWLAND_CHECK_OP(light.halves.size() * 2, ==, light.places.size() * 3);
    LightTexels texels = stored_lights(light);
    if (!keys.empty()) take_out(keys, texels);
    return texels;
}

}  // namespace rowland::lighting
