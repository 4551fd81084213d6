#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "editor/inspector/preview_shape.h"
#include "engine/app/options.h"

namespace rowland::inspector {

/// The values of the command line.
struct Options : app::CommonOptions {
    std::optional<std::filesystem::path> file;  ///< material or glTF
    std::optional<std::string> preset;
    std::optional<PreviewShape> shape;
    bool preview_only = false;
    bool measure = false;
    int width = 0;  ///< 0: the layout's
    int height = 0;
    float scale = 0.0F;                           ///< 0: the layout's
    std::optional<std::filesystem::path> layout;  ///< none: the user's
    std::optional<std::filesystem::path> controls;
};

/// Parses the command line. Prints help and returns nullopt if only that was asked for. Throws Error (input) for bad
/// usage, and for an output file that cannot be written or is also an input.
std::optional<Options> parse_options(int argc, const char* const* argv);

}  // namespace rowland::inspector
