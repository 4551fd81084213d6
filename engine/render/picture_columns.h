#pragma once

namespace rowland::render {

/// Component: the entity shows in these columns of the picture only, given as shares of its width from its left side.
/// Two entities in one place that share the picture between them cost what one does, but for their vertices.
struct PictureColumns {
    float begin = 0.0F;
    float end = 1.0F;
};

}  // namespace rowland::render
