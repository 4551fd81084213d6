#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec4.hpp>
#include <vector>

#include "engine/image/byte_image.h"

namespace rowland::diffraction::foil {

/// A PNG whose RGBA is a function of column and row.
inline std::vector<std::byte> drawn_png(int width, int height, const std::function<glm::u8vec4(int, int)>& colour) {
    std::vector<std::uint8_t> rgba;
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column)
            for (int c = 0; c < 4; ++c) rgba.push_back(colour(column, row)[c]);
    return image::encode_png(width, height, 4, rgba);
}

}  // namespace rowland::diffraction::foil
