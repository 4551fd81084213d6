#include "engine/lighting/light_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>
#include <optional>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/environment_map.h"

namespace rowland::lighting {

namespace {

/// Numbers of parts along x and y into which a texel is divided, so that no part is longer than `largest_side` radians.
glm::ivec2 parts_of(const ProbeImage& probe, double largest_side) {
    const auto parts = [largest_side](double side) {
        return std::max(1, static_cast<int>(std::ceil(side / largest_side - 1e-9)));
    };
    const double width = 2.0 * std::numbers::pi / probe.image().width;
    if (probe.mapping() == Mapping::Angular) return glm::ivec2(parts(width));
    return {parts(width), parts(std::numbers::pi / probe.image().height)};
}

/// The probe resampled bilinearly at `parts` times its resolution.
ProbeImage divide_texels(const ProbeImage& probe, const glm::ivec2& parts) {
    image::Image fine = image::make_image(probe.image().width * parts.x, probe.image().height * parts.y);
    parallel_for(static_cast<std::size_t>(fine.height), [&](std::size_t task) {
        const int row = static_cast<int>(task);
        for (int column = 0; column < fine.width; ++column)
            fine.at(column, row) =
                glm::vec3(probe.radiance(probe.direction((column + 0.5) / parts.x, (row + 0.5) / parts.y)));
    });
    return {std::move(fine), probe.mapping()};
}

/// A probe whose texels have sides of at most `largest_side`: the given probe if it is fine enough.
class FineProbe {
 public:
    FineProbe(const ProbeImage& probe, double largest_side) : probe_(&probe) {
        ROWLAND_CHECK_OP(largest_side, >, 0.0);
        const glm::ivec2 parts = parts_of(probe, largest_side);
        if (parts != glm::ivec2(1)) probe_ = &divided_.emplace(divide_texels(probe, parts));
    }
    FineProbe(const FineProbe&) = delete;
    FineProbe& operator=(const FineProbe&) = delete;
    const ProbeImage& operator*() const { return *probe_; }
    const ProbeImage* operator->() const { return probe_; }

 private:
    std::optional<ProbeImage> divided_;
    const ProbeImage* probe_;
};

/// A sample for each texel of rows [first, end).
LightSamples row_samples(const ProbeImage& probe, int first, int end) {
    const int width = probe.image().width;
    LightSamples samples;
    samples.resize(static_cast<std::size_t>(end - first) * static_cast<std::size_t>(width));
    parallel_for(static_cast<std::size_t>(end - first), [&](std::size_t task) {
        const int row = first + static_cast<int>(task);
        const bool same_in_row = probe.mapping() == Mapping::Equirectangular;
        double solid_angle = same_in_row ? probe.solid_angle(0, row) : 0.0;
        for (int column = 0; column < width; ++column) {
            if (!same_in_row) solid_angle = probe.solid_angle(column, row);
            samples.set(task * static_cast<std::size_t>(width) + static_cast<std::size_t>(column),
                        probe.direction(column + 0.5, row + 0.5),
                        solid_angle * glm::dvec3(probe.image().at(column, row)));
        }
    });
    return samples;
}

/// How the flux of a lobe divides among cells: `fractions[i]` goes to cell `indices[i]`; they sum to 1.
struct LobeFractions {
    std::vector<std::size_t> indices;
    std::vector<double> fractions;
};

/// Distributes the lobe's flux over `count` cells, `direction(i)` and `solid_angle(i)`, by the midpoint rule.
template <typename Direction, typename SolidAngle>
LobeFractions lobe_fractions(const KeyLight& key, std::size_t count, const Direction& direction,
                             const SolidAngle& solid_angle) {
    // Directions with a larger κ(1 − cos θ) are skipped: their density is below exp(−30) of the peak.
    constexpr double kCutoff = 30.0;
    LobeFractions result;
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 s = direction(i);
        if (key.concentration * (1.0 - glm::dot(s, key.direction)) >= kCutoff) continue;
        result.indices.push_back(i);
        result.fractions.push_back(lobe_density(key, s) * solid_angle(i));
        sum += result.fractions.back();
    }
    for (double& fraction : result.fractions) fraction /= sum;
    return result;
}

/// Calls subtract_from_cell(i, flux) with each lobe's flux in cell i, of `count` cells with sides of at most `side`
/// radians. Lobes of a standard deviation 1/√κ below a side, unresolved by the midpoint rule, become negative samples.
template <typename Direction, typename SolidAngle, typename Subtract>
void subtract_lobes(std::span<const KeyLight> keys, double side, std::size_t count, const Direction& direction,
                    const SolidAngle& solid_angle, LightSamples& samples, const Subtract& subtract_from_cell) {
    const auto is_resolved = [&](std::size_t k) { return keys[k].concentration * side * side < 1.0; };
    std::vector<LobeFractions> lobes(keys.size());
    parallel_for(keys.size(), [&](std::size_t k) {
        if (is_resolved(k)) lobes[k] = lobe_fractions(keys[k], count, direction, solid_angle);
    });
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (!is_resolved(k)) subtract_narrow_lobe(keys[k], samples);
        for (std::size_t j = 0; j < lobes[k].indices.size(); ++j)
            subtract_from_cell(lobes[k].indices[j], lobes[k].fractions[j] * keys[k].flux);
    }
}

/// Adds samples to the cells of a cube map.
class CellAccumulator {
 public:
    explicit CellAccumulator(int face_size) : layout_{face_size, 1}, cells_(layout_.offset(1)) {
        ROWLAND_CHECK_OP(face_size, >=, 1);
    }

    void add(const LightSamples& samples) {
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const glm::dvec3 flux = samples.flux(i);
            const double weight = std::abs(flux.x) + std::abs(flux.y) + std::abs(flux.z);
            if (weight == 0.0) continue;
            const glm::dvec3 direction = samples.direction(i);
            const CubePoint point = cube_point(direction);
            const double size = layout_.face_size;
            const glm::dvec2 at = 0.5 * size * glm::dvec2(point.s + 1.0, point.t + 1.0);
            const glm::dvec2 corner = glm::clamp(glm::floor(at), glm::dvec2(0.0), glm::dvec2(size - 1.0));
            CubeCell& cell =
                cells_[layout_.index(0, point.face, static_cast<int>(corner.x), static_cast<int>(corner.y))];
            cell.flux += flux;
            cell.direction_sum += weight * direction;
            cell.position_sum += weight * (at - corner);
        }
    }
    std::vector<CubeCell> result() { return std::move(cells_); }

 private:
    CubeLayout layout_;
    std::vector<CubeCell> cells_;
};

}  // namespace

void LightSamples::resize(std::size_t size) {
    for (auto* array : {&x, &y, &z, &red, &green, &blue}) array->resize(size);
}

void LightSamples::set(std::size_t i, const glm::dvec3& direction, const glm::dvec3& flux) {
    x[i] = static_cast<float>(direction.x);
    y[i] = static_cast<float>(direction.y);
    z[i] = static_cast<float>(direction.z);
    red[i] = static_cast<float>(flux.x);
    green[i] = static_cast<float>(flux.y);
    blue[i] = static_cast<float>(flux.z);
}

void LightSamples::push_back(const glm::dvec3& direction, const glm::dvec3& flux) {
    for (auto* array : {&x, &y, &z, &red, &green, &blue}) array->push_back(0.0F);
    set(size() - 1, direction, flux);
}

LightSamples light_samples(const ProbeImage& probe, std::span<const KeyLight> keys, double largest_side) {
    const FineProbe fine(probe, largest_side);
    LightSamples texels = row_samples(*fine, 0, fine->image().height);
    const auto width = static_cast<std::size_t>(fine->image().width);
    const double side = std::max(2.0 * std::numbers::pi / fine->image().width, std::numbers::pi / fine->image().height);
    subtract_lobes(
        keys, side, texels.size(), [&](std::size_t i) { return texels.direction(i); },
        [&](std::size_t i) { return fine->solid_angle(static_cast<int>(i % width), static_cast<int>(i / width)); },
        texels,
        [&](std::size_t i, const glm::dvec3& flux) {
            const glm::vec3 lobe(flux);
            texels.red[i] -= lobe.x;
            texels.green[i] -= lobe.y;
            texels.blue[i] -= lobe.z;
        });
    return texels;
}

void subtract_narrow_lobe(const KeyLight& key, LightSamples& samples) {
    // The density over t = κ(1 − cos) is exp(−t): Gauss–Laguerre quadrature.
    struct Node {
        double t;
        double weight;
    };
    constexpr std::array<Node, 3> kNodes{{{0.4157745567834791, 0.7110930099291730},
                                          {2.2942803602790417, 0.2785177335692408},
                                          {6.2899450829374792, 0.0103892565015861}}};
    constexpr int kAngles = 8;
    ROWLAND_CHECK_OP(key.concentration, >=, 100.0);
    const glm::dvec3 helper = std::abs(key.direction.y) < 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 tangent = glm::normalize(glm::cross(helper, key.direction));
    const glm::dvec3 bitangent = glm::cross(key.direction, tangent);
    for (const Node& node : kNodes) {
        const double one_minus_cos = node.t / key.concentration;
        const double sine = std::sqrt(one_minus_cos * (2.0 - one_minus_cos));
        for (int i = 0; i < kAngles; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / kAngles;
            samples.push_back((1.0 - one_minus_cos) * key.direction +
                                  sine * (std::cos(angle) * tangent + std::sin(angle) * bitangent),
                              -node.weight / kAngles * key.flux);
        }
    }
}

std::vector<CubeCell> bin_into_cells(const ProbeImage& probe, int face_size) {
    const FineProbe fine(probe, kMaximumTexelSide);
    const int height = fine->image().height;
    const int rows = std::max(1, (1 << 18) / fine->image().width);  // per block: about 6 MB of samples
    CellAccumulator cells(face_size);
    for (int row = 0; row < height; row += rows) cells.add(row_samples(*fine, row, std::min(height, row + rows)));
    return cells.result();
}

std::vector<CubeCell> bin_into_cells(const LightSamples& texels, int face_size) {
    CellAccumulator cells(face_size);
    cells.add(texels);
    return cells.result();
}

LightSamples cell_samples(std::span<const CubeCell> cells) {
    LightSamples samples;
    for (const CubeCell& cell : cells)
        if (cell.direction_sum != glm::dvec3(0.0)) samples.push_back(glm::normalize(cell.direction_sum), cell.flux);
    return samples;
}

LightSamples merge_samples(const LightSamples& texels, int face_size) {
    return cell_samples(bin_into_cells(texels, face_size));
}

namespace {

/// Cells per side of the cube faces on which lobes are sampled; a cell's longest side is 2 / kLobeFace.
constexpr int kLobeFace = 128;

/// Steps of a position along a cell's side.
constexpr double kPositionSteps = 256.0;

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
    return static_cast<std::uint8_t>(std::clamp(std::floor(position * kPositionSteps), 0.0, kPositionSteps - 1.0));
}

LightSamples stored_samples(const PackedLight& light) {
    const std::size_t count = light.halves.size() / 3;
    LightSamples samples;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 stored(from_half(light.halves[i]), from_half(light.halves[count + i]),
                                from_half(light.halves[2 * count + i]));
        if (stored == glm::dvec3(0.0)) continue;
        samples.push_back(
            direction_in(cell_at(i, light.face_size), light.face_size, (light.positions[i] + 0.5) / kPositionSteps,
                         (light.positions[count + i] + 0.5) / kPositionSteps),
            static_cast<double>(light.scale) * stored);
    }
    return samples;
}

/// Appends the lobes as samples of negative flux at the cell centres of a fixed cube; at the stored samples'
/// directions, which are off centre, the lobes would shift.
void subtract(std::span<const KeyLight> keys, LightSamples& samples) {
    constexpr auto kSide = static_cast<std::size_t>(kLobeFace);
    std::vector<glm::dvec3> directions(6 * kSide * kSide);
    std::vector<double> solid_angles(kSide * kSide);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const Cell cell = cell_at(i, kLobeFace);
        directions[i] = direction_in(cell, kLobeFace, 0.5, 0.5);
        if (cell.face == 0) solid_angles[i] = cube_solid_angle(kLobeFace, cell.column, cell.row);
    }
    std::vector<glm::dvec3> flux(directions.size(), glm::dvec3(0.0));
    subtract_lobes(
        keys, 2.0 / kLobeFace, directions.size(), [&](std::size_t i) { return directions[i]; },
        [&](std::size_t i) { return solid_angles[i % solid_angles.size()]; }, samples,
        [&](std::size_t i, const glm::dvec3& of_lobe) { flux[i] += of_lobe; });
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
        const glm::dvec2 position = weight > 0.0 ? cells[i].position_sum / weight : glm::dvec2(0.5);
        packed.positions[i] = position_byte(position.x);
        packed.positions[cells.size() + i] = position_byte(position.y);
    }
    return packed;
}

PackedLight pack(const LightSamples& texels, int face_size) {
    return pack(bin_into_cells(texels, face_size), face_size);
}

LightSamples unpack(const PackedLight& light, std::span<const KeyLight> keys) {
    ROWLAND_CHECK_OP(light.halves.size() * 2, ==, light.positions.size() * 3);
    LightSamples samples = stored_samples(light);
    if (!keys.empty()) subtract(keys, samples);
    return samples;
}

}  // namespace rowland::lighting
