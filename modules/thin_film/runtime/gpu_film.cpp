#include "modules/thin_film/runtime/gpu_film.h"

#include <glm/matrix.hpp>
#include <span>
#include <utility>
#include <vector>

#include "engine/colour/working_space.h"

namespace rowland::thin_film {

namespace {

bool fits_a_line(const FilmTable& table) {
    return table.rows == 1 && table.layers <= 2;
}

/// Four components a texel: columns of M in the working space, one after another.
std::vector<glm::vec4> working_columns(const FilmTable& table, const glm::dmat3& xyz_to_working) {
    const glm::dmat3 working_to_rec709 = glm::inverse(xyz_to_working * colour::rec709_to_xyz());
    std::vector<glm::vec4> columns;
    columns.reserve(3 * table.values.size());
    for (int column = 0; column < 3; ++column)
        for (const glm::mat3& value : table.values)
            columns.emplace_back(glm::mat3(xyz_to_working * glm::dmat3(value) * working_to_rec709)[column], 0.0F);
    return columns;
}

/// A line is small, and software renderers read floats faster than halves.
gpu::Texture upload(const FilmTable& table, const glm::dmat3& xyz_to_working) {
    const int slices = 3 * table.layers;
    const bool line = fits_a_line(table);
    gpu::Texture texture({.kind = line ? gpu::TextureKind::Line : gpu::TextureKind::Volume,
                          .format = line ? gpu::Format::RGBA32F : gpu::Format::RGBA16F,
                          .width = line ? slices * table.columns : table.columns,
                          .height = table.rows,
                          .depth = line ? 1 : slices});
    texture.upload(std::span<const glm::vec4>(working_columns(table, xyz_to_working)),
                   {.layers = texture.desc().depth});
    return texture;
}

/// Scale and bias from [begin, end] to the centres of the first and the last of `nodes` texels.
glm::vec2 to_texels(double begin, double end, int nodes) {
    const double scale = end > begin ? (nodes - 1) / ((end - begin) * nodes) : 0.0;
    return {scale, 0.5 / nodes - begin * scale};
}

glm::vec4 axes(const FilmTable& table) {
    const glm::vec2 columns = to_texels(0.0, 1.0, table.columns);
    const auto slices = static_cast<float>(3 * table.layers);
    if (fits_a_line(table)) return {columns / slices, static_cast<float>(table.layers - 1) / slices, 1.0F / 3.0F};
    return {columns, table.roughest > 0.0 ? (table.layers - 1) / table.roughest : 0.0, 1.0F / slices};
}

}  // namespace

GpuFilm::GpuFilm(const FilmTable& table, const glm::dmat3& xyz_to_working, std::string illuminant)
    : texture_(upload(table, xyz_to_working)),
      path_((table.index - 1.0) * (table.index + 1.0), to_texels(table.begin_nm, table.end_nm, table.rows),
            table.layers - 1),
      axes_(axes(table)),
      illuminant_(std::move(illuminant)) {}

void GpuFilm::bind(const gpu::Program& program) const {
    texture_.bind(kFilmTableUnit);
    program.set("film_path", path_);
    program.set("film_axes", axes_);
}

}  // namespace rowland::thin_film
