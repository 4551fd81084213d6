#include "tests/gpu/modules/diffraction/filter_error.h"

#include <glm/common.hpp>
#include <initializer_list>

#include "modules/diffraction/runtime/gpu_map.h"

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

}  // namespace

PlanarMap filter_error(const PlanarMap& map) {
    PlanarMap error = map;
    const auto azimuths = static_cast<std::size_t>(map.azimuths);
    error.xyz = error_of(map.xyz, {{.texels = azimuths, .stride = 1, .repeats = true},
                                   {.texels = static_cast<std::size_t>(map.views), .stride = azimuths},
                                   {.texels = static_cast<std::size_t>(map.slices()),
                                    .stride = azimuths * static_cast<std::size_t>(map.views)}});
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
    CircleMap error = map;
    for (CircleGrid* grid : {&error.terms, &error.remainder}) {
        if (grid->functions == 0) continue;
        const auto side = static_cast<std::size_t>(grid->side);
        const std::size_t slices = side * side * static_cast<std::size_t>(grid->views);
        grid->xyz = error_of(grid->xyz, {{.texels = side, .stride = 1},
                                         {.texels = side, .stride = side},
                                         {.texels = static_cast<std::size_t>(grid->views), .stride = side * side}});
        if (grid == &error.remainder) {
            // Rounded to ten bits, of either sign.
            const float step = largest_component(map.remainder.xyz) / 1023.0F;
            for (glm::vec3& value : grid->xyz) value += step;
            continue;
        }
        // In the term whose factor is 1: the others' factors are within [−1, 1].
        const std::size_t chart = slices * static_cast<std::size_t>(grid->functions);
        const std::vector<glm::vec3> by_term =
            std::exchange(grid->xyz, std::vector<glm::vec3>(grid->xyz.size(), glm::vec3(0.0F)));
        for (std::size_t i = 0; i < by_term.size(); ++i) grid->xyz[i / chart * chart + i % slices] += by_term[i];
    }
    return error;
}

StreakMap filter_error(const StreakMap& map) {
    StreakMap error = map;
    for (int i = 0; i < kStreakLevels; ++i) {
        const auto level = static_cast<std::size_t>(i);
        const auto columns = static_cast<std::size_t>(map.columns(i));
        const auto rows = static_cast<std::size_t>(map.rows(i));
        error.levels[level] =
            error_of(map.levels[level],
                     {{.texels = columns, .stride = 1},
                      {.texels = rows, .stride = columns},
                      {.texels = static_cast<std::size_t>(map.slices(i)), .stride = columns * rows, .repeats = true}});
        for (std::size_t texel = 0; texel < map.levels[level].size(); ++texel)
            error.levels[level][texel] += static_cast<float>(kPositionError) * glm::abs(map.levels[level][texel]);
    }
    return error;
}

namespace {

void make_positive(StreakSegment& segment) {
    for (glm::mat3& weight : segment.weights)
        for (int c = 0; c < 3; ++c) weight[c] = glm::abs(weight[c]);
}

}  // namespace

Streak filter_error(const Streak& streak) {
    Streak error = streak;
    for (StreakSegment& segment : error.segments) make_positive(segment);
    return error;
}

}  // namespace rowland::diffraction
