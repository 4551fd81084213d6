#pragma once

#include <glm/vec2.hpp>
#include <memory>

#include "content/demo/options.h"
#include "engine/post/ocio_config.h"
#include "engine/view/picture.h"

namespace rowland::demo {

/// Whether what takes long may be spread over frames.
enum class Pace {
    Fluent,  ///< a window: maps fill by and by
    Still,   ///< pictures: a map is full in the second frame at rest
};

/// A picture that shows diffraction, with the effects that the options ask for. Throws Error (input) for an unknown
/// view.
std::unique_ptr<view::Picture> open_picture(const Options& options, const post::OcioConfig& config, glm::ivec2 size,
                                            Pace pace);

}  // namespace rowland::demo
