#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "modules/thin_film/bake/film_table.h"

namespace rowland::thin_film {

// As in shaders/.
inline constexpr unsigned kFilmTableUnit = 8;
inline constexpr unsigned kFactorMapUnit = 9;
inline constexpr unsigned kThicknessMapUnit = 10;

/// A film's table on the GPU, in the working space.
class GpuFilm {
 public:
    /// `illuminant`: the name of that which the table was baked for.
    GpuFilm(const FilmTable& table, const glm::dmat3& xyz_to_working, std::string illuminant);

    void bind(const gpu::Program& program) const;
    /// Of the shaders that read it.
    const std::vector<gpu::Define>& defines() const { return defines_; }
    const std::string& illuminant() const { return illuminant_; }

 private:
    gpu::Texture texture_;
    std::vector<gpu::Define> defines_;
    glm::vec4 path_;
    glm::vec4 axes_;
    std::string illuminant_;
};

}  // namespace rowland::thin_film
