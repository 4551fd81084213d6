#pragma once

#include <span>
#include <string_view>

namespace rowland {

/// A text file of the source tree that the build put into the program: rowland_embed_files() in EmbedFiles.cmake.
struct EmbeddedFile {
    std::string_view name;  ///< path from the top of the source tree: "engine/post/shaders/exposure.frag.glsl"
    std::string_view text;
};

/// The text of the file of that name, which must be among `files`.
std::string_view embedded_text(std::span<const EmbeddedFile> files, std::string_view name);

}  // namespace rowland
