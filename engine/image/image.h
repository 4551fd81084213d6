#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace rowland::image {

/// Linear RGB image, row 0 at the top. Values are as the file holds them: they may be negative, infinite or NaN.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> texels;  ///< width*height, row by row

    const glm::vec3& at(int column, int row) const {
        return texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(column)];
    }
    glm::vec3& at(int column, int row) {
        return texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(column)];
    }
};

}  // namespace rowland::image
