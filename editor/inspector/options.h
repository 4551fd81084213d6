#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "editor/inspector/preview_shape.h"

namespace rowland::inspector {

/// What the command line asks for.
struct Options {
    std::optional<std::filesystem::path> file;  ///< material or glTF
    std::optional<std::string> preset;
    std::optional<std::filesystem::path> probe;
    std::string probe_mapping = "equirect";
    std::optional<PreviewShape> shape;
    std::optional<std::filesystem::path> ocio_config;
    std::optional<std::filesystem::path> capture;
    bool preview_only = false;
    bool measure = false;
    int width = 0;  ///< 0: the layout's
    int height = 0;
    float scale = 0.0F;                           ///< 0: the layout's
    std::optional<std::filesystem::path> layout;  ///< none: the user's
    std::optional<std::filesystem::path> controls;
    std::filesystem::path content_folder;
};

/// Parses the command line. Throws Error (input) for bad usage; nothing if it only asked for help, which is printed
/// then.
std::optional<Options> parse_options(int argc, const char* const* argv);

}  // namespace rowland::inspector
