#include "modules/thin_film/runtime/gpu_film.h"

#include <cmath>
#include <glm/matrix.hpp>
#include <span>
#include <utility>
#include <vector>

#include "engine/colour/working_space.h"

namespace rowland::thin_film {

namespace {

bool is_line(const FilmTable& table) {
    return table.rows == 1 && table.layers <= 2;
}

/// One thickness, all roughnesses: layers are rows.
bool has_roughnesses(const FilmTable& table) {
    return table.layers > 2;
}

/// Columns of M in the working space, one after another. The fourth components are the reflectance of white.
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

/// Software renderers read floats faster than halves.
gpu::Texture upload(const FilmTable& table, const glm::dmat3& xyz_to_working) {
    const int slices = 3 * table.layers;
    const bool line = is_line(table);
    gpu::Texture texture({.kind = line ? gpu::TextureKind::Line : gpu::TextureKind::Plane,
                          .format = gpu::Format::RGBA32F,
                          .width = line ? slices * table.columns : table.columns,
                          .height = line ? 1 : table.rows * slices});
    texture.upload(std::span<const glm::vec4>(working_columns(table, xyz_to_working)));
    return texture;
}

/// Scale and bias from [begin, end] to the centres of the first and the last of `nodes` texels.
glm::vec2 to_texels(double begin, double end, int nodes) {
    const double scale = end > begin ? (nodes - 1) / ((end - begin) * nodes) : 0.0;
    return {scale, 0.5 / nodes - begin * scale};
}

/// film_path and film_axes of the shaders.
struct Axes {
    glm::vec4 path;
    glm::vec4 axes;
};

Axes axes(const FilmTable& table) {
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

std::vector<gpu::Define> defines_for(const FilmTable& table) {
    if (is_line(table)) return {{"FILM_LINE", "1"}};
    if (has_roughnesses(table)) return {{"FILM_ROUGHNESSES", "1"}};
    if (table.by_lobe_nodes) return {{"FILM_LOBE_NODES", "1"}};
    return {};
}

}  // namespace

GpuFilm::GpuFilm(const FilmTable& table, const glm::dmat3& xyz_to_working, std::string illuminant)
    : texture_(upload(table, xyz_to_working)), defines_(defines_for(table)), illuminant_(std::move(illuminant)) {
    const Axes of_table = axes(table);
    path_ = of_table.path;
    axes_ = of_table.axes;
}

void GpuFilm::bind(const gpu::Program& program) const {
    texture_.bind(kFilmTableUnit);
    program.set("film_path", path_);
    program.set("film_axes", axes_);
}

}  // namespace rowland::thin_film
