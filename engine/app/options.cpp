#include "engine/app/options.h"

#include <CLI/CLI.hpp>

namespace rowland::app {

void add_common_options(CLI::App& app, CommonOptions& options, const std::string& capture_help) {
    app.add_option("--probe", options.probe, "Light probe: .hdr, .exr, a probe recipe (.json) or a cooked .probe");
    app.add_option("--probe-mapping", options.probe_mapping,
                   "How an image covers the sphere: equirect, angular, or auto (recognised)")
        ->check(CLI::IsMember({"auto", "equirect", "angular"}))
        ->capture_default_str();
    app.add_option("--ocio", options.ocio_config, "OpenColorIO config in place of $OCIO and the shipped one");
    app.add_option("--display", options.display, "Display of the OpenColorIO config (a wrong name lists them)");
    app.add_option("--view", options.view, "View of the display (a wrong name lists them)");
    app.add_option("--capture", options.capture, capture_help);
    app.add_option("--content-folder", options.content_folder,
                   "Sources of the shipped assets: materials, probes, meshes and scenes")
        ->capture_default_str();
    app.add_flag("--gl-debug", options.gl_debug, "Log the messages of the OpenGL driver, each once; slower");
}

post::OcioConfig open_ocio_config(const CommonOptions& options) {
    post::OcioConfig config = post::OcioConfig::choose(options.ocio_config);
    config.prefer(options.display, options.view);
    return config;
}

std::vector<std::filesystem::path> given(
    std::initializer_list<std::reference_wrapper<const std::optional<std::filesystem::path>>> options) {
    std::vector<std::filesystem::path> paths;
    for (const std::optional<std::filesystem::path>& option : options)
        if (option) paths.push_back(*option);
    return paths;
}

}  // namespace rowland::app
