#include "editor/inspector/options.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <vector>

#include "engine/command_line/command_line.h"
#include "engine/core/outputs.h"

namespace rowland::inspector {

namespace {

constexpr const char* kFooter =
    "example:\n"
    "  rowland-inspector my_foil.json --probe stage.hdr --shape sheet\n"
    "  rowland-inspector --preset dvd --capture inspector.png --size 1600x1000\n\n"
    "Drop a material, a glTF file, a probe or a table of efficiencies onto the window to open it.\n"
    "Keys: F1 lists all. Tab and arrows move through all controls, Space and Enter use them; Ctrl+Z undoes and\n"
    "Ctrl+Shift+Z redoes, Ctrl+S saves, Ctrl+O opens, Ctrl+= and Ctrl+- change the size of text, Ctrl+1 to Ctrl+5\n"
    "choose the shape, F6 compares with the saved version, F12 writes a screenshot. Drag the preview to orbit, turn\n"
    "the wheel to zoom, click to pick a point.";

void read_size(const std::string& text, Options& options) {
    int used = 0;
    const bool read = std::sscanf(text.c_str(), "%5dx%5d%n", &options.width, &options.height, &used) == 2;
    const auto sane = [](int size) { return size >= 320 && size <= 8192; };
    if (!read || static_cast<std::size_t>(used) != text.size() || !sane(options.width) || !sane(options.height))
        throw CLI::ValidationError("--size", "'" + text + "' is no size such as 1280x800, each side 320 to 8192");
}

void check_outputs(const Options& options) {
    std::vector<Output> outputs;
    if (options.capture) outputs.push_back({"--capture", *options.capture, ".png"});
    if (options.controls) outputs.push_back({"--controls", *options.controls});
    if (options.layout && !options.capture) outputs.push_back({"--layout", *options.layout});
    std::vector<std::filesystem::path> inputs = app::given({options.file, options.probe, options.ocio_config});
    if (options.preset) inputs.push_back(options.content_folder / "materials" / (*options.preset + ".json"));
    rowland::check_outputs(inputs, outputs);
}

}  // namespace

std::optional<Options> parse_options(int argc, const char* const* argv) {
    CLI::App app{"Rowland's material inspector: edit a grating and see its colours, its physics and its cost.",
                 "rowland-inspector"};
    app.footer(kFooter);
    Options options;
    options.content_folder = std::filesystem::path(ROWLAND_SOURCE_DIR) / "content";
    std::string shape;
    app.add_option("FILE", options.file, "A material (.json), or a glTF file whose mesh and grating to start from");
    app.add_option("--preset", options.preset, "Start from a shipped material: cd, cd_r, dvd, blu_ray, ruled_600, …");
    app::add_common_options(app, options, "Write the window as PNG once all is computed, without opening a window");
    app.add_option("--shape", shape, "Shape of the preview: disc, sphere, card, sheet")
        ->check(CLI::IsMember({"disc", "sphere", "card", "sheet"}));
    app.add_flag("--preview-only", options.preview_only, "Capture the preview alone");
    app.add_flag("--measure", options.measure, "Measure all choices before the capture");
    app.add_option_function<std::string>(
        "--size", [&](const std::string& text) { read_size(text, options); },
        "Size of the window or the capture, as 1280x800");
    app.add_option("--scale", options.scale, "Size of text and controls")->check(finite(0.5, 4.0));
    app.add_option("--layout", options.layout, "File of the layout (default: in the user's configuration)");
    app.add_option("--controls", options.controls, "Write the positions of all controls to a file, for automation");
    if (!parse_command_line(app, argc, argv)) return std::nullopt;
    options.shape = parse_preview_shape(shape);
    check_outputs(options);
    return options;
}

}  // namespace rowland::inspector
