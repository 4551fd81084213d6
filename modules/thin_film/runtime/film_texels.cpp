#include "modules/thin_film/runtime/film_texels.h"

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "engine/colour/colour_space.h"

namespace rowland::thin_film {

bool is_line(const FilmTable& table) {
    return table.rows == 1 && table.layers <= 2;
}

bool has_roughnesses(const FilmTable& table) {
    return table.layers > 2;
}

std::vector<glm::vec4> working_columns(const FilmTable& table, const glm::dmat3& xyz_to_working) {
    const glm::dmat3 working_to_rec709 = glm::inverse(xyz_to_working * colour::rec709_to_xyz());
    std::vector<glm::vec4> columns;
    columns.reserve(3 * table.values.size());
    for (int column = 0; column < 3; ++column)
        for (const glm::mat3& value : table.values) {
            const glm::mat3 working(xyz_to_working * glm::dmat3(value) * working_to_rec709);
            columns.emplace_back(working[column], (working * glm::vec3(1.0F))[column]);
        }
    return columns;
}

glm::ivec2 texture_size(const FilmTable& table) {
    const int slices = 3 * table.layers;
    return is_line(table) ? glm::ivec2(slices * table.columns, 1) : glm::ivec2(table.columns, table.rows * slices);
}

namespace {

/// Scale and bias that map begin and end to the centres of the first and the last of `nodes` texels.
glm::vec2 to_texels(double begin, double end, int nodes) {
    const double scale = end > begin ? (nodes - 1) / ((end - begin) * nodes) : 0.0;
    return {scale, 0.5 / nodes - begin * scale};
}

}  // namespace

FilmAxes film_axes(const FilmTable& table) {
    const auto slices = static_cast<float>(3 * table.layers);
    const auto last = static_cast<float>(table.layers - 1);
    const auto square = static_cast<float>((table.index - 1.0) * (table.index + 1.0));
    const glm::vec2 columns =
        to_texels(std::sqrt(FilmTable::kCosineOffset), std::sqrt(1.0 + FilmTable::kCosineOffset), table.columns);
    const glm::vec2 rows = to_texels(table.begin, table.end, table.rows);
    if (is_line(table)) return {{square, 0.0F, 0.0F, 0.0F}, {columns / slices, last / slices, 1.0F / 3.0F}};
    if (has_roughnesses(table)) {
        const glm::vec2 roughnesses = to_texels(0.0, table.roughest, table.layers) / 3.0F;
        return {{square, roughnesses, table.roughest}, {columns, 0.0F, 1.0F / 3.0F}};
    }
    return {{square, rows / slices, 0.0F}, {columns, last / slices, 1.0F / 3.0F}};
}

}  // namespace rowland::thin_film
