#pragma once

#include <chrono>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "content/demo/play/play.h"

namespace rowland::test {

/// A square of 0.2 m in the x-y plane around a point, as seen from +Z.
std::shared_ptr<const scene::Mesh> square();

/// Two squares before a camera at (0, 0, 1): "left" at x = -0.15 turns by itself about its normal and stands on a node
/// that is turned and scaled; "right" at x = 0.15 lies still. The window has 400 x 400 points, so that 0.0025 m of the
/// plane are one.
struct SmallWorld {
    SmallWorld();
    demo::Toys toys() const;
    demo::Play play();

    ecs::World world;
    ecs::Entity root, stand, left, right;
};

inline constexpr glm::ivec2 kWindow{400, 400};
inline constexpr glm::dvec2 kOnLeft{140.0, 200.0};   ///< the middle of the square
inline constexpr glm::dvec2 kOnRight{260.0, 200.0};  ///< likewise
inline constexpr glm::dvec2 kBeside{200.0, 30.0};

demo::PlayEvent key(platform::Key key, bool down);
demo::PlayEvent mouse(glm::dvec2 place);
demo::PlayEvent button(bool down);
demo::PlayEvent wheel(double notches);

/// Steps in which nothing happens.
void wait(demo::Play& play, int steps);
/// Presses and releases in two steps.
void tap(demo::Play& play, platform::Key which);
/// Takes what is at `from` and drags it by `per_step` in each of `steps` steps; the button stays down.
void drag(demo::Play& play, glm::dvec2 from, glm::dvec2 per_step, int steps);

}  // namespace rowland::test
