#pragma once

#include <string_view>

namespace rowland::gpu {

/// A text file of the source tree that the build put into the program (EmbedShaders.cmake).
struct EmbeddedFile {
    std::string_view name;  ///< path from the top of the source tree: "engine/post/shaders/exposure.frag.glsl"
    std::string_view text;
};

}  // namespace rowland::gpu
