#include "tests/gpu/modules/diffraction/filter_error.h"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <initializer_list>
#include <span>
#include <vector>

#include "engine/lighting/environment_map.h"

namespace rowland::diffraction {

namespace {

/// An axis of a table: how many texels, and how far apart they lie.
struct TableAxis {
    std::size_t texels = 0;
    std::size_t stride = 0;
    bool repeats = false;
};

/// Adds an axis's part of the error to each texel.
void add_axis(std::span<const glm::vec3> values, const TableAxis& axis, std::vector<glm::vec3>& error) {
    const std::size_t extent = axis.texels * axis.stride;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t at = i % extent / axis.stride;
        const std::size_t line = i - at * axis.stride;
        const auto difference = [&](std::size_t neighbour) {
            return glm::abs(values[line + neighbour % axis.texels * axis.stride] - values[i]);
        };
        glm::vec3 largest(0.0F);
        if (at > 0 || axis.repeats) largest = difference(at + axis.texels - 1);
        if (at + 1 < axis.texels || axis.repeats) largest = glm::max(largest, difference(at + 1));
        error[i] += static_cast<float>(kPositionError) * largest;
    }
}

std::vector<glm::vec3> error_of(std::span<const glm::vec3> values, std::initializer_list<TableAxis> axes) {
    std::vector<glm::vec3> error(values.size(), glm::vec3(0.0F));
    for (const TableAxis& axis : axes) add_axis(values, axis, error);
    return error;
}

/// Of a level's texels, by look-ups as far to each side.
glm::dvec3 level_error(const CubePyramid& pyramid, const glm::dvec3& direction, int level) {
    const glm::dvec3 here = pyramid.at_level(direction, level);
    const lighting::CubePoint point = lighting::cube_point(direction);
    const double step = 2.0 * kPositionError / pyramid.layout().size(level);
    const auto change = [&](double s, double t) {
        return glm::abs(pyramid.at_level(lighting::cube_direction(point.face, point.s + s, point.t + t), level) - here);
    };
    return glm::max(change(step, 0.0), change(-step, 0.0)) + glm::max(change(0.0, step), change(0.0, -step));
}

glm::dvec3 sample_error(const CubePyramid& pyramid, const glm::dvec3& direction, double level) {
    const glm::dvec3 here = pyramid.at_level(direction, level);
    const auto change = [&](double to) { return glm::abs(pyramid.at_level(direction, to) - here); };
    const int last = pyramid.layout().levels - 1;
    const int fine = std::clamp(static_cast<int>(level), 0, last);
    const double between = std::clamp(level - fine, 0.0, 1.0);
    return glm::max(change(level - kPositionError), change(level + kPositionError)) +
           (1.0 - between) * level_error(pyramid, direction, fine) +
           between * level_error(pyramid, direction, std::min(fine + 1, last));
}

}  // namespace

PlanarMap filter_error(const PlanarMap& map) {
    PlanarMap error = map;
    const auto azimuths = static_cast<std::size_t>(map.azimuths);
    error.xyz = error_of(map.xyz, {{.texels = azimuths, .stride = 1, .repeats = true},
                                   {.texels = static_cast<std::size_t>(map.views), .stride = azimuths}});
    return error;
}

LobeMap filter_error(const LobeMap& map) {
    LobeMap error = map;
    const auto g = static_cast<std::size_t>(map.size.views.g);
    const auto h = static_cast<std::size_t>(map.size.views.h);
    error.values = error_of(map.values, {{.texels = g, .stride = 1},
                                         {.texels = h, .stride = g},
                                         {.texels = static_cast<std::size_t>(slices(map.size, map.half_turn)),
                                          .stride = g * h,
                                          .repeats = !map.half_turn}});
    return error;
}

LobeTable filter_error(const LobeTable& table) {
    LobeTable error = table;
    const auto columns = static_cast<std::size_t>(table.columns);
    error.values = error_of(table.values, {{.texels = columns, .stride = 1},
                                           {.texels = static_cast<std::size_t>(table.rows), .stride = columns}});
    return error;
}

CircleMap filter_error(const CircleMap& map) {
    const auto side = static_cast<std::size_t>(map.side);
    const std::size_t slices = side * side * static_cast<std::size_t>(map.views);
    const std::vector<glm::vec3> by_term =
        error_of(map.xyz, {{.texels = side, .stride = 1},
                           {.texels = side, .stride = side},
                           {.texels = static_cast<std::size_t>(map.views), .stride = side * side}});
    CircleMap error = map;
    std::fill(error.xyz.begin(), error.xyz.end(), glm::vec3(0.0F));
    const std::size_t chart = slices * static_cast<std::size_t>(map.terms);
    for (std::size_t i = 0; i < by_term.size(); ++i) error.xyz[i / chart * chart + i % slices] += by_term[i];
    return error;
}

glm::dvec3 filter_error(const CubePyramid& pyramid, const glm::dvec3& direction, const glm::dvec3& a,
                        const glm::dvec3& b, int most_taps) {
    const CubePyramid::Samples samples = pyramid.samples(a, b, most_taps);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < samples.count; ++i) sum += sample_error(pyramid, direction + samples.offset(i), samples.level);
    return sum / static_cast<double>(samples.count);
}

}  // namespace rowland::diffraction
