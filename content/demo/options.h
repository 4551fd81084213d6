#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "engine/app/drawing_program.h"

namespace rowland::demo {

/// The values of the command line.
struct Options : app::CommonOptions {
    std::optional<std::filesystem::path> scene;
    bool disc = false;  ///< one CD in place of the cabinet
    std::optional<std::filesystem::path> mesh;
    std::optional<std::filesystem::path> material;
    bool headless = false;
    int width = 1280;
    int height = 720;
    std::optional<int> frames;  ///< none: 1 for captures, 12 for a flight, 300 for a benchmark, all of a recording
    std::string light_window = "auto";
    double dome_radius_m = 10.0;  ///< of the room that a probe image is shown as; 0: infinitely far away
    float exposure_stops = 0.0F;
    float bloom = 0.0F;                          ///< fraction of the light that is scattered
    std::optional<std::filesystem::path> glare;  ///< a material to look through
    float vignette = 0.0F;  ///< fraction of the light lost in the corners, on top of the lens' own falloff
    bool auto_exposure = false;
    std::optional<float> f_number;  ///< of the lens; none: everything is in focus
    std::optional<float> focus_m;   ///< none: the view's target is in focus
    float grain = 0.0F;             ///< deviation of display values in mid-tones
    bool dither = false;
    std::optional<double> gratings_ms;  ///< GPU time for all gratings of a frame; none: not limited
    bool ambient_occlusion = true;      ///< and contact shadows
    bool soft_shadows = true;
    bool local_reflections = true;               ///< mirrors show the table and objects, not only the probe
    bool rough_reflections = false;              ///< rough surfaces look the probe up in four directions
    bool sun = false;                            ///< a lamp that casts shadows
    std::optional<std::array<float, 6>> camera;  ///< eye and target, metres
    std::optional<std::string> frame_object;     ///< whose bounds the first view shows
    std::optional<int> turntable;                ///< pictures once around the view's target
    bool list_views = false;
    std::optional<std::filesystem::path> capture_linear;
    std::optional<std::filesystem::path> benchmark;
    std::optional<std::filesystem::path> record;  ///< a recording to write
    std::optional<std::filesystem::path> play;    ///< a recording to play back
    bool watch = true;                            ///< reload files that change
    std::filesystem::path output_folder = "demo";
    std::filesystem::path cooked_folder;
    std::filesystem::path shader_folder;

    /// Pictures that a capture writes.
    int captured_frames() const { return turntable.value_or(frames.value_or(1)); }
    bool captures() const { return capture || capture_linear; }
};

/// Parses the command line. Prints help and returns nullopt if only that was asked for. Throws Error (input) for bad
/// usage.
std::optional<Options> parse_options(int argc, const char* const* argv);

/// Throws Error (input) if an output file cannot be written or is also an input. To be called before work begins.
void check_outputs(const Options& options);

}  // namespace rowland::demo
