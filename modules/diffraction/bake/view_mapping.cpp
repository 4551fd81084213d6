#include "modules/diffraction/bake/view_mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/parallel.h"

namespace rowland::diffraction {

namespace {

using std::numbers::pi;

/// Indexed by ViewMapping.
constexpr std::array<std::string_view, 3> kViewMappingNames{"spherical", "parabolic", "one-dimensional"};

/// Far above any use, and small enough that no product of sizes overflows.
constexpr int kMaximumNodes = 1 << 14;

/// The position of a node in [−1, 1] at equal steps.
double signed_node(int index, int count) {
    return 2.0 * index / (count - 1) - 1.0;
}

AxisLookup look_up_repeated(double turns, std::size_t count) {
    const double n = static_cast<double>(count);
    double position = std::fmod(turns * n, n);
    if (position < 0.0) position += n;
    if (!(position >= 0.0)) position = 0.0;  // a NaN
    const auto first = std::min(static_cast<std::size_t>(position), count - 1);
    return {first, (first + 1) % count, position - static_cast<double>(first)};
}

}  // namespace

const char* view_mapping_name(ViewMapping mapping) {
    return kViewMappingNames.at(static_cast<std::size_t>(mapping)).data();
}

ViewMapping parse_view_mapping(std::string_view name) {
    const auto found = std::find(kViewMappingNames.begin(), kViewMappingNames.end(), name);
    ROWLAND_CHECK(found != kViewMappingNames.end(), name);
    return static_cast<ViewMapping>(found - kViewMappingNames.begin());
}

glm::dvec2 node_view(const ViewGrid& grid, int column, int row) {
    switch (grid.mapping) {
        case ViewMapping::Spherical: {
            const double theta = 0.5 * pi * static_cast<double>(row) / static_cast<double>(grid.rows - 1);
            const double phi = 2.0 * pi * static_cast<double>(column) / static_cast<double>(grid.columns);
            return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi)};
        }
        case ViewMapping::Parabolic: {
            const glm::dvec2 p(signed_node(column, grid.columns), signed_node(row, grid.rows));
            return p * (2.0 / (1.0 + glm::dot(p, p)));
        }
        case ViewMapping::OneDimensional:
            break;
    }
    return {signed_node(column, grid.columns), 0.0};
}

std::size_t mirrored_texel(const ViewGrid& grid, int column, int row) {
    if (grid.mapping == ViewMapping::Spherical) column = (grid.columns - column) % grid.columns;
    if (grid.mapping == ViewMapping::Parabolic) row = grid.rows - 1 - row;
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column);
}

AxisLookup look_up_axis(double position, std::size_t count) {
    const double last = static_cast<double>(count - 1);
    // A NaN becomes the first node.
    const double node = position > 0.0 ? std::min(position * last, last) : 0.0;
    const auto first = static_cast<std::size_t>(node);
    return {first, std::min(first + 1, count - 1), node - static_cast<double>(first)};
}

BilinearLookup combine(const AxisLookup& columns, const AxisLookup& rows, std::size_t row_length) {
    BilinearLookup result;
    result.texel = {rows.first * row_length + columns.first, rows.first * row_length + columns.second,
                    rows.second * row_length + columns.first, rows.second * row_length + columns.second};
    result.weight = {(1.0 - rows.weight) * (1.0 - columns.weight), (1.0 - rows.weight) * columns.weight,
                     rows.weight * (1.0 - columns.weight), rows.weight * columns.weight};
    return result;
}

BilinearLookup look_up(const ViewGrid& grid, double v_g, double v_h, double v_n) {
    const auto columns = static_cast<std::size_t>(grid.columns);
    const auto rows = static_cast<std::size_t>(grid.rows);
    switch (grid.mapping) {
        case ViewMapping::Spherical: {
            const double theta = std::atan2(std::hypot(v_g, v_h), v_n);
            const double phi = std::atan2(v_h, v_g);
            return combine(look_up_repeated(phi / (2.0 * pi), columns), look_up_axis(theta / (0.5 * pi), rows),
                           columns);
        }
        case ViewMapping::Parabolic: {
            const double scale = 0.5 / (1.0 + std::max(v_n, 0.0));
            return combine(look_up_axis(0.5 + v_g * scale, columns), look_up_axis(0.5 + v_h * scale, rows), columns);
        }
        case ViewMapping::OneDimensional:
            break;
    }
    return combine(look_up_axis(0.5 + 0.5 * v_g, columns), AxisLookup{}, columns);
}

bool is_valid(const ViewGrid& grid) {
    const int columns = grid.mapping == ViewMapping::Spherical ? 1 : 2;
    if (grid.columns < columns || grid.columns > kMaximumNodes || grid.rows > kMaximumNodes) return false;
    return grid.mapping == ViewMapping::OneDimensional ? grid.rows == 1 : grid.rows >= 2;
}

void check_view_grid(const ViewGrid& grid, const Grating& grating) {
    ROWLAND_CHECK(is_valid(grid), "a view grid's sizes must be those of its mapping");
    if (grid.mapping != ViewMapping::OneDimensional || sees_v_g_alone(grating)) return;
    throw Error({.file = {},
                 .location = "view_mapping",
                 .found = fmt::format("one-dimensional for {}",
                                      grating.lattice ? "a lattice" : "a groove lobe that is not flat"),
                 .expected = "spherical or parabolic: radiance also depends on v_h",
                 .remedy = "change view_mapping"});
}

std::vector<double> mirror_signs(int bands) {
    std::vector<double> signs;
    for (int l = 0; l < bands; ++l)
        for (int m = -l; m <= l; ++m) signs.push_back(m < 0 ? -1.0 : 1.0);
    return signs;
}

void for_each_view(const char* title, const ViewGrid& grid, const Grating& grating,
                   const std::function<void(const glm::dvec2&, std::size_t, std::size_t)>& body) {
    struct Task {
        int column, row;
        std::size_t texel, mirror;
    };
    std::vector<Task> tasks;
    std::size_t texel = 0;
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column, ++texel) {
            const std::size_t mirror = grating.lattice ? texel : mirrored_texel(grid, column, row);
            if (texel <= mirror) tasks.push_back({column, row, texel, mirror});
        }
    Progress progress(title, tasks.size());
    parallel_for(tasks.size(), [&](std::size_t i) {
        const Task& task = tasks[i];
        body(node_view(grid, task.column, task.row), task.texel, task.mirror);
        progress.advance();
    });
}

double filtered(const PackedTexels& packed, std::size_t layer, std::size_t texels_per_layer, std::size_t component,
                const BilinearLookup& lookup) {
    double sum = 0.0;
    for (std::size_t i = 0; i < lookup.texel.size(); ++i)
        if (lookup.weight[i] != 0.0)
            sum += lookup.weight[i] * packed.value(layer, layer * texels_per_layer + lookup.texel[i], component);
    return sum;
}

ViewMapping to_view_mapping(const ByteReader& reader, unsigned number) {
    if (number > static_cast<unsigned>(ViewMapping::OneDimensional))
        reader.fail(fmt::format("view mapping {}", number), "0 (spherical), 1 (parabolic) or 2 (one-dimensional)");
    return static_cast<ViewMapping>(number);
}

void write_view_grid(const ViewGrid& grid, ByteWriter& writer) {
    writer.value(static_cast<std::uint8_t>(grid.mapping));
    writer.value<std::int32_t>(grid.columns);
    writer.value<std::int32_t>(grid.rows);
}

ViewGrid read_view_grid(ByteReader& reader) {
    ViewGrid grid;
    grid.mapping = to_view_mapping(reader, reader.value<std::uint8_t>());
    grid.columns = read_count(reader, "columns", 1, kMaximumNodes);
    grid.rows = read_count(reader, "rows", 1, kMaximumNodes);
    if (!is_valid(grid))
        reader.fail(fmt::format("{} x {} nodes", grid.columns, grid.rows),
                    fmt::format("a {} table's", view_mapping_name(grid.mapping)));
    return grid;
}

}  // namespace rowland::diffraction
