#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <vector>

namespace rowland::post {

/// Where a flat periodic sheet before the camera, facing it, sends light that passes: light from direction cosines
/// (x right, y up, in the picture) is also seen at that + offset, for each point. Colours are linear and of the
/// picture's space, in and out. Energy is kept if `straight` and the weights of all points sum to at most the identity.
struct GlarePattern {
    struct Point {
        glm::vec2 offset{0.0F};
        glm::mat3 weight{0.0F};
    };
    glm::mat3 straight{1.0F};  ///< of the light that passes straight through
    std::vector<Point> points;
};

}  // namespace rowland::post
