#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace rowland::demo {

/// What the command line asks for.
struct Options {
    std::optional<std::filesystem::path> probe;
    std::string probe_mapping = "equirect";
    std::optional<std::filesystem::path> scene;
    bool disc = false;  ///< one CD, in place of the cabinet
    std::optional<std::filesystem::path> mesh;
    std::optional<std::filesystem::path> material;
    std::optional<std::filesystem::path> ocio_config;
    bool headless = false;
    int width = 1280;
    int height = 720;
    std::optional<int> frames;  ///< none: 1 for captures, 12 for a flight, 300 for a benchmark, all of a play
    std::string light_window = "auto";
    std::string view;
    float exposure_stops = 0.0F;
    float bloom = 0.0F;     ///< share of the light that is scattered
    float vignette = 0.0F;  ///< share of the light lost in the corners, beside the lens' own
    bool auto_exposure = false;
    bool dither = false;
    bool sun = false;  ///< a lamp that casts shadows
    bool list_views = false;
    std::optional<std::filesystem::path> capture;
    std::optional<std::filesystem::path> capture_linear;
    std::optional<std::filesystem::path> benchmark;
    std::optional<std::filesystem::path> record;  ///< where what the user does is written
    std::optional<std::filesystem::path> play;    ///< such a file, to be done again
    bool watch = true;                            ///< follow changes of files
    std::filesystem::path output_folder = "demo";
    std::filesystem::path cooked_folder;
    std::filesystem::path content_folder;  ///< the sources of the cooked assets
    std::filesystem::path shader_folder;
};

/// Parses the command line. Throws Error (input) for bad usage; nothing if it only asked for help, which is printed
/// then.
std::optional<Options> parse_options(int argc, const char* const* argv);

}  // namespace rowland::demo
