#include "content/demo/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "content/demo/assets.h"
#include "content/demo/play/action.h"
#include "engine/command_line/command_line.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/program.h"
#include "engine/view/picture.h"

namespace rowland::demo {

namespace {

constexpr const char* kFooter =
    "example:\n"
    "  rowland-demo --headless --probe capture.hdr --probe-mapping angular --capture picture.png\n\n"
    "With a display, and neither --headless nor a capture, the demo opens a window. Otherwise it writes a short "
    "flight\n"
    "through the scene to the output folder, or the captures, lit by the first probe. With --frames above 1 the scene\n"
    "moves from frame to frame, and the file names get the frame's number.\n\n"
    "While the window is open, the demo reloads shaders, assets and their sources when they are saved. If one is\n"
    "broken, the picture stays and the title says why. Drop a probe onto the window to light the scene with it.\n\n"
    "in the window:\n";

std::array<float, 6> read_camera(const std::string& text) {
    std::array<float, 6> camera{};
    const char* rest = text.data();
    const char* const end = text.data() + text.size();
    for (std::size_t i = 0; i < camera.size(); ++i) {
        const auto [next, failure] = std::from_chars(rest, end, camera[i]);
        const bool last = i + 1 == camera.size();
        const bool separated = last ? next == end : next != end && *next == ',';
        if (failure != std::errc() || !separated || !std::isfinite(camera[i]))
            throw CLI::ValidationError("--camera", "'" + text + "' is no view such as 0,0.2,0.5,0,0,0");
        rest = last ? next : next + 1;
    }
    if (std::equal(camera.begin(), camera.begin() + 3, camera.begin() + 3))
        throw CLI::ValidationError("--camera", "the eye of '" + text + "' is on its target");
    return camera;
}

void add_options(CLI::App& app, Options& options) {
    app::add_common_options(app, options, "Write the picture as PNG");
    app.add_flag("--headless", options.headless, "Render without a window");
    app.add_option(
        "--scene", options.scene,
        "glTF, GLB or cooked .scene file to show in place of the cabinet. glTF and GLB are cooked first, once\n"
        "for each content. A scene with a camera is shown alone and unscaled");
    app.add_flag("--disc", options.disc, "Show one CD between two spheres in place of the cabinet");
    app.add_option("--mesh", options.mesh, "glTF or GLB file to show as a grating in place of that CD");
    app.add_option("--material", options.material, "Material of that CD or mesh: .json, or a cooked .material");
    app.add_option("--width", options.width, "Width in pixels")->check(finite(1, 16384))->capture_default_str();
    app.add_option("--height", options.height, "Height in pixels")->check(finite(1, 16384))->capture_default_str();
    app.add_option("--frames", options.frames,
                   "Frames to render, 1/30 s apart. Default: 1 for captures, 300 for a benchmark, all of a recording,\n"
                   "12 for the flight, which they divide evenly")
        ->check(finite(1, 100000));
    app.add_option("--dome", options.dome_radius_m,
                   "Radius in metres of the room that a probe's image is shown as, captured 1.6 m above its floor;\n"
                   "0: infinitely far away")
        ->check(finite(0.0, lighting::kLargestDome_m))
        ->capture_default_str();
    app.add_option("--light-window", options.light_window,
                   "Window against ringing of the grating's light; auto: the weakest sufficient one")
        ->check(CLI::IsMember({"auto", "none", "lanczos", "hann"}))
        ->capture_default_str();
    app.add_option("--exposure", options.exposure_stops, "Exposure in stops")
        ->check(finite(-32.0, 32.0))
        ->capture_default_str();
    app.add_option("--glare", options.glare, "Material to look through, as glasses or a screen: .json");
    app.add_option("--bloom", options.bloom, "Fraction of the light that the lens scatters")->check(finite(0.0, 1.0));
    app.add_option("--vignette", options.vignette, "Fraction of the light lost in the corners")
        ->check(finite(0.0, 1.0));
    app.add_flag("--auto-exposure", options.auto_exposure, "Expose for the picture's mean; --exposure is added");
    app.add_option("--f-number", options.f_number, "Depth of field: the lens' focal length over its aperture")
        ->check(finite(0.5, 64.0));
    app.add_option("--focus", options.focus_m,
                   "Distance in focus, in metres along the view, with --f-number or F6. Default: the view's target")
        ->check(finite(0.01, 10000.0));
    app.add_option("--grain", options.grain, "Film grain: the deviation of display values in mid-tones")
        ->check(finite(0.0, 0.5));
    app.add_option(
           "--gratings-ms", options.gratings_ms,
           "Time of the GPU that all gratings may take in a frame; they are drawn by the cooked choices that give "
           "the least error within it. Default: not limited")
        ->check(finite(0.01, 100.0));
    app.add_flag("--dither", options.dither, "Hide the steps of 8-bit gradients");
    app.add_flag("--no-ambient-occlusion{false}", options.ambient_occlusion, "Do not darken corners and contacts");
    app.add_flag("--no-soft-shadows{false}", options.soft_shadows, "Give shadows sharp edges");
    app.add_flag("--no-local-reflections{false}", options.local_reflections, "Let mirrors show only the probe");
    app.add_flag("--rough-reflections", options.rough_reflections,
                 "Sum what rough surfaces reflect over four directions, not one");
    app.add_flag("--sun", options.sun, "Add a lamp that casts shadows");
    app.add_option_function<std::string>(
        "--camera", [&](const std::string& text) { options.camera = read_camera(text); },
        "The first view, as x,y,z,tx,ty,tz: eye and target in metres");
    app.add_option("--frame-object", options.frame_object,
                   "Point the first view at the object of this name, as the Gratings panel lists it");
    app.add_option("--turntable", options.turntable, "Write so many captures on a circle around the view's target")
        ->check(finite(1, 10000))
        ->excludes("--frames");
    app.add_flag("--list-views", options.list_views, "List the views of the display and stop");
    app.add_option("--capture-linear", options.capture_linear, "Write the scene-linear picture as OpenEXR");
    app.add_option("--benchmark", options.benchmark,
                   "Fly once around the scene without a window and write the times of frames and passes as JSON");
    CLI::Option* record = app.add_option("--record", options.record, "Record what the user does in the window");
    app.add_option("--play", options.play, "Play a recording back; with --headless in frames of 1/30 s")
        ->excludes(record);
    app.add_flag("--no-watch{false}", options.watch, "Do not reload assets, sources and shaders when they change");
    app.add_option("--output-folder", options.output_folder, "Folder of pictures that have no --capture")
        ->take_last()
        ->capture_default_str();
    app.add_option("--cooked-folder", options.cooked_folder, "Cooked assets (default: ../cooked beside the program)");
    app.add_option("--shader-folder", options.shader_folder, "Source tree that shaders are reloaded from")
        ->capture_default_str();
}

bool is_numbered(const std::filesystem::path& file, const std::filesystem::path& capture) {
    const std::string name = file.stem().string();
    const std::string start = capture.stem().string() + "_";
    return file.extension() == capture.extension() && name.starts_with(start) && name.size() > start.size() &&
           name.find_first_not_of("0123456789", start.size()) == std::string::npos;
}

/// Adds the picture; of several frames, the first one's and all numbered ones that exist and would be overwritten.
void add_captures(std::vector<Output>& outputs, const Options& options, const char* option,
                  const std::optional<std::filesystem::path>& path, const char* extension) {
    if (!path) return;
    const bool one = !options.play && options.captured_frames() == 1;
    const std::filesystem::path first = view::numbered(*path, 0, one ? 1 : 2);
    outputs.push_back({option, first, extension});
    std::error_code ignored;
    for (const auto& file :
         std::filesystem::directory_iterator(std::filesystem::absolute(first).parent_path(), ignored))
        if (!one && is_numbered(file, *path) && file.path().filename() != first.filename())
            outputs.push_back({option, file, extension});
}

}  // namespace

std::optional<Options> parse_options(int argc, const char* const* argv) {
    CLI::App app{"Rowland's demo: a grating under a light probe, shaded by Lindsay & Agu's method.", "rowland-demo"};
    app.footer(std::string(kFooter) + help_text());
    Options options;
    options.shader_folder = resources_folder(ROWLAND_SOURCE_DIR);
    options.content_folder = options.shader_folder / "content";
    add_options(app, options);
    if (!parse_command_line(app, argc, argv)) return std::nullopt;
    constexpr double kCameraHeight_m = lighting::CaptureDome{}.height_m;
    if (options.dome_radius_m > 0.0 && options.dome_radius_m <= kCameraHeight_m)
        refuse_input("--dome", "", fmt::format("{:g}", options.dome_radius_m),
                     fmt::format("0, or more than the {:g} m of the camera above the floor", kCameraHeight_m));
    if (options.turntable && !options.captures())
        refuse_input("--turntable", "", "no --capture", "a file that the pictures are named after",
                     "add --capture turn.png");
    if (options.cooked_folder.empty()) options.cooked_folder = default_cooked_folder();
    if (!options.scene && !options.mesh && !options.material && !options.disc)
        options.scene = options.cooked_folder / "cabinet.scene";
    return options;
}

void check_outputs(const Options& options) {
    std::vector<Output> outputs;
    add_captures(outputs, options, "--capture", options.capture, ".png");
    add_captures(outputs, options, "--capture-linear", options.capture_linear, ".exr");
    if (options.benchmark) outputs.push_back({"--benchmark", *options.benchmark});
    if (options.record) outputs.push_back({"--record", *options.record});
    std::vector<std::filesystem::path> inputs =
        app::given({options.probe, options.ocio_config, options.scene, options.mesh, options.material, options.glare,
                    options.play});
    for (const cook::Recooker::Job& job : shipped_jobs(options)) inputs.insert(inputs.end(), {job.source, job.output});
    rowland::check_outputs(inputs, outputs);
}

}  // namespace rowland::demo
