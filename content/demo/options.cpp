#include "content/demo/options.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "content/demo/play/action.h"
#include "engine/core/error.h"

namespace rowland::demo {

namespace {

constexpr const char* kFooter =
    "example:\n"
    "  rowland-demo --headless --probe capture.hdr --probe-mapping angular --capture picture.png\n\n"
    "With a display, and neither --headless nor a capture, the demo opens in a window. Else a short flight through "
    "the\n"
    "scene is written to the output folder, or the pictures that the captures name, of the first probe. With --frames\n"
    "above 1 what moves does so from frame to frame, and the frame's number is put into the names of the files.\n\n"
    "While the window is open, shaders, assets and their sources are followed: save a file and see it; if it is "
    "broken\n"
    "the picture stays and the title says why. Drop a probe onto the window to light the scene by it.\n\n"
    "in the window:\n";

void add_options(CLI::App& app, Options& options) {
    app.add_flag("--headless", options.headless, "Render without a window, as where there is no display");
    app.add_option("--probe", options.probe, "Light probe: .hdr, .exr, a probe recipe (.json) or a cooked .probe");
    app.add_option("--probe-mapping", options.probe_mapping, "How an image covers the sphere: equirect or angular")
        ->capture_default_str();
    app.add_option("--scene", options.scene,
                   "glTF or GLB file to show, with its own materials, in place of the cabinet; if it brings a\ncamera, "
                   "alone and as it is");
    app.add_flag("--disc", options.disc, "Show one CD between two spheres in place of the cabinet");
    app.add_option("--mesh", options.mesh, "glTF or GLB file to show as a grating in place of that CD");
    app.add_option("--material", options.material, "Material of that CD or mesh: .json, or a cooked .material");
    app.add_option("--ocio", options.ocio_config, "OpenColorIO config in place of $OCIO and the shipped one");
    app.add_option("--width", options.width, "Width in pixels")->check(CLI::Range(1, 16384))->capture_default_str();
    app.add_option("--height", options.height, "Height in pixels")->check(CLI::Range(1, 16384))->capture_default_str();
    app.add_option(
           "--frames", options.frames,
           "Frames to render, 1/30 s apart: 1 for captures, 300 for a benchmark, at most all of a play;\nthose of "
           "the flight share its way: 12")
        ->check(CLI::Range(1, 100000));
    app.add_option("--light-window", options.light_window,
                   "Window against ringing of the grating's light; auto: the mildest that does")
        ->check(CLI::IsMember({"auto", "none", "lanczos", "hann"}))
        ->capture_default_str();
    app.add_option("--view", options.view, "View of the display (see --list-views)");
    app.add_option("--exposure", options.exposure_stops, "Exposure in stops")
        ->check(CLI::Range(-32.0F, 32.0F))
        ->capture_default_str();
    app.add_option("--bloom", options.bloom, "Share of the light that the lens scatters, 0 to 1")
        ->check(CLI::Range(0.0F, 1.0F));
    app.add_option("--vignette", options.vignette, "Share of the light lost in the corners, 0 to 1")
        ->check(CLI::Range(0.0F, 1.0F));
    app.add_flag("--auto-exposure", options.auto_exposure, "Expose for the picture's mean; --exposure is added");
    app.add_flag("--dither", options.dither, "Hide the steps of 8-bit gradients");
    app.add_flag("--sun", options.sun, "Add a lamp that casts shadows");
    app.add_flag("--list-views", options.list_views, "List the views of the display and stop");
    app.add_option("--capture", options.capture, "Write the picture as PNG");
    app.add_option("--capture-linear", options.capture_linear, "Write the scene-linear picture as OpenEXR");
    app.add_option("--benchmark", options.benchmark,
                   "Fly once around the scene without a window and write the times of frames and passes as JSON");
    CLI::Option* record =
        app.add_option("--record", options.record, "Write what the user does in the window to a file");
    app.add_option("--play", options.play, "Do again what such a file says; with --headless in frames of 1/30 s")
        ->excludes(record);
    app.add_flag("--no-watch{false}", options.watch, "Do not follow changes of assets, their sources and shaders");
    app.add_option("--output-folder", options.output_folder, "Where pictures without --capture go")
        ->take_last()
        ->capture_default_str();
    app.add_option("--cooked-folder", options.cooked_folder, "Cooked assets (default: ../cooked beside the program)");
    app.add_option("--content-folder", options.content_folder, "Sources of the cooked assets, cooked again on change")
        ->capture_default_str();
    app.add_option("--shader-folder", options.shader_folder, "Source tree that shaders are reloaded from")
        ->capture_default_str();
}

}  // namespace

std::optional<Options> parse_options(int argc, const char* const* argv) {
    CLI::App app{"Rowland's demo: a grating under a light probe, shaded by Lindsay & Agu's method.", "rowland-demo"};
    app.footer(std::string(kFooter) + help_text());
    Options options;
    options.shader_folder = ROWLAND_SOURCE_DIR;
    options.content_folder = options.shader_folder / "content";
    add_options(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::fputs(app.help().c_str(), stdout);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        throw Error({.file = "rowland-demo",
                     .place = {},
                     .found = error.what(),
                     .expected = {},
                     .remedy = "see rowland-demo --help"});
    }
    return options;
}

}  // namespace rowland::demo
