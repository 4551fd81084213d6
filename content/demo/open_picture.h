#pragma once

#include <glm/vec2.hpp>
#include <memory>

#include "content/demo/options.h"
#include "engine/post/ocio_config.h"
#include "engine/view/picture.h"

namespace rowland::demo {

/// Whether maps may fill over several frames.
enum class Pace {
    Fluent,  ///< for a window: incrementally
    Still,   ///< for pictures: a map is full in the second frame in which nothing moves
};

/// A picture that shows diffraction, with the effects that the options ask for. Throws Error (input) for an unknown
/// view.
std::unique_ptr<view::Picture> open_picture(const Options& options, const post::OcioConfig& config, glm::ivec2 size,
                                            Pace pace);

}  // namespace rowland::demo
