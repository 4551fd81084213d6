#include "modules/thin_film/runtime/gpu_film.h"

#include <cstdint>
#include <glm/gtc/packing.hpp>
#include <glm/matrix.hpp>
#include <span>
#include <utility>
#include <vector>

#include "engine/colour/working_space.h"

namespace rowland::thin_film {

namespace {

gpu::Texture upload(const FilmTable& table, const glm::dmat3& xyz_to_working) {
    const glm::dmat3 working_to_rec709 = glm::inverse(xyz_to_working * colour::rec709_to_xyz());
    std::vector<std::uint16_t> halves;
    halves.reserve(12 * table.values.size());
    for (int column = 0; column < 3; ++column)
        for (const glm::mat3& value : table.values) {
            const glm::mat3 working(xyz_to_working * glm::dmat3(value) * working_to_rec709);
            for (int row = 0; row < 3; ++row) halves.push_back(glm::packHalf1x16(working[column][row]));
            halves.push_back(0);
        }
    gpu::Texture texture({.kind = gpu::TextureKind::Volume,
                          .format = gpu::Format::RGBA16F,
                          .width = table.columns,
                          .height = table.rows,
                          .depth = 3 * table.layers});
    texture.upload(std::span<const std::uint16_t>(halves), {.layers = 3 * table.layers});
    return texture;
}

/// Scale and bias from [begin, end] to the centres of the first and the last of `nodes` texels.
glm::vec2 to_texels(double begin, double end, int nodes) {
    const double scale = end > begin ? (nodes - 1) / ((end - begin) * nodes) : 0.0;
    return {scale, 0.5 / nodes - begin * scale};
}

}  // namespace

GpuFilm::GpuFilm(const FilmTable& table, const glm::dmat3& xyz_to_working, std::string illuminant)
    : texture_(upload(table, xyz_to_working)),
      path_((table.index - 1.0) * (table.index + 1.0), to_texels(table.begin_nm, table.end_nm, table.rows),
            table.layers - 1),
      axes_(to_texels(0.0, 1.0, table.columns), table.roughest > 0.0 ? (table.layers - 1) / table.roughest : 0.0,
            1.0 / (3.0 * table.layers)),
      illuminant_(std::move(illuminant)) {}

void GpuFilm::bind(const gpu::Program& program) const {
    texture_.bind(kFilmTableUnit);
    program.set("film_path", path_);
    program.set("film_axes", axes_);
}

}  // namespace rowland::thin_film
