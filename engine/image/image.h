#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace rowland::image {

/// Linear RGB image, row 0 at the top. Values are as the file holds them: they may be negative, infinite or NaN.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> texels;  ///< width*height, row by row

    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
    }
    const glm::vec3& at(int column, int row) const { return texels[index(column, row)]; }
    glm::vec3& at(int column, int row) { return texels[index(column, row)]; }
};

inline Image make_image(int width, int height) {
    return {
        width, height,
        std::vector<glm::vec3>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), glm::vec3(0.0F))};
}

/// Multiplies every texel.
inline void transform_colours(Image& image, const glm::dmat3& matrix) {
    for (glm::vec3& texel : image.texels) texel = glm::vec3(matrix * glm::dvec3(texel));
}

}  // namespace rowland::image
