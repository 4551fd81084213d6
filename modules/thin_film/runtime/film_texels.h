#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "modules/thin_film/bake/film_table.h"

namespace rowland::thin_film {

/// Whether all nodes are along one line of texels: one thickness, and at most one roughness.
bool is_line(const FilmTable& table);

/// Whether the table has one thickness, and its roughness varies along the texture's rows.
bool has_roughnesses(const FilmTable& table);

/// The texels of shaders/film_lookup.glsl: columns of the reflectance matrix M, PHYSICS (4.2), in the working space.
/// Fourth components: reflectance of white.
std::vector<glm::vec4> working_columns(const FilmTable& table, const glm::dmat3& xyz_to_working);

/// Width and height of the texture of working_columns().
glm::ivec2 texture_size(const FilmTable& table);

/// film_path and film_axes of the shader.
struct FilmAxes {
    glm::vec4 path;
    glm::vec4 axes;
};

FilmAxes film_axes(const FilmTable& table);

}  // namespace rowland::thin_film
