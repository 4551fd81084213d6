#pragma once

namespace rowland::render {

/// Component: limits the entity to these columns of the picture, given as fractions of its width from the left. Two
/// entities at one position that split the picture cost as many pixels as one.
struct PictureColumns {
    float begin = 0.0F;
    float end = 1.0F;
};

}  // namespace rowland::render
