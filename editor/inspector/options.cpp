#include "editor/inspector/options.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "engine/core/error.h"

namespace rowland::inspector {

namespace {

constexpr const char* kFooter =
    "example:\n"
    "  rowland-inspector my_foil.json --probe stage.hdr --shape sheet\n"
    "  rowland-inspector --preset dvd --capture inspector.png --size 1600x1000\n\n"
    "Drop a material, a glTF file, a probe or a table of efficiencies onto the window to open it.\n"
    "Keys: Tab and arrows move through all controls, Space and Enter use them; Ctrl+Z and Ctrl+Shift+Z go back and\n"
    "forth, Ctrl+S saves, Ctrl+O opens, Ctrl+= and Ctrl+- change the size of text, F1 to F5 choose the shape, F6\n"
    "compares with the saved version. Drag the preview to orbit, wheel to zoom, click to pick a point.";

/// "1280x800".
void read_size(const std::string& text, Options& options) {
    int used = 0;
    const bool read = std::sscanf(text.c_str(), "%dx%d%n", &options.width, &options.height, &used) == 2;
    const auto sane = [](int size) { return size >= 320 && size <= 8192; };
    if (!read || static_cast<std::size_t>(used) != text.size() || !sane(options.width) || !sane(options.height))
        throw CLI::ValidationError("--size", "'" + text + "' is no size such as 1280x800, each side 320 to 8192");
}

}  // namespace

std::optional<Options> parse_options(int argc, const char* const* argv) {
    CLI::App app{"Rowland's material inspector: author a grating, see its physics, know its price.",
                 "rowland-inspector"};
    app.footer(kFooter);
    Options options;
    options.content_folder = std::filesystem::path(ROWLAND_SOURCE_DIR) / "content";
    std::string shape;
    std::string size;
    app.add_option("FILE", options.file, "A material (.json), or a glTF file to show and whose grating to start from");
    app.add_option("--preset", options.preset, "Start from a shipped material: cd, dvd, blu_ray, ruled_600, …");
    app.add_option("--probe", options.probe, "Light probe: .hdr, .exr or a probe recipe (.json)");
    app.add_option("--probe-mapping", options.probe_mapping, "How an image covers the sphere: equirect or angular")
        ->check(CLI::IsMember({"equirect", "angular"}))
        ->capture_default_str();
    app.add_option("--shape", shape, "What the material is shown on: disc, sphere, card, sheet")
        ->check(CLI::IsMember({"disc", "sphere", "card", "sheet"}));
    app.add_option("--ocio", options.ocio_config, "OpenColorIO config in place of $OCIO and the shipped one");
    app.add_option("--capture", options.capture, "Write the window as PNG once all is computed, without a window");
    app.add_flag("--preview-only", options.preview_only, "Capture the preview alone");
    app.add_flag("--measure", options.measure, "Measure all choices before the capture");
    app.add_option("--size", size, "Size of the window or the capture, as 1280x800");
    app.add_option("--scale", options.scale, "Size of text and controls, 0.5 to 4")->check(CLI::Range(0.5F, 4.0F));
    app.add_option("--layout", options.layout, "Where the layout is kept (default: the user's configuration)");
    app.add_option("--controls", options.controls, "Keep a file of where all controls are, for those who drive them");
    app.add_option("--content-folder", options.content_folder, "Holds the presets and the shipped probes")
        ->capture_default_str();
    try {
        app.parse(argc, argv);
        if (!size.empty()) read_size(size, options);
    } catch (const CLI::CallForHelp&) {
        std::fputs(app.help().c_str(), stdout);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        throw Error({.file = "rowland-inspector",
                     .place = {},
                     .found = error.what(),
                     .expected = {},
                     .remedy = "see rowland-inspector --help"});
    }
    options.shape = parse_preview_shape(shape);
    return options;
}

}  // namespace rowland::inspector
