#include "engine/app/drawing_program.h"

#include <fmt/format.h>

#include <chrono>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gpu/context.h"
#include "engine/platform/gl_context.h"
#include "engine/platform/window.h"

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

void render_offscreen(bool debug, const std::function<void(const std::string& renderer)>& body) {
    const platform::HeadlessContext context({.debug = debug});
    if (debug) gpu::enable_debug_output(false);
    log_info("rendering on {}", context.renderer());
    const auto started = std::chrono::steady_clock::now();
    body(context.renderer());
    log_info("done in {:.1f} s", std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count());
}

void require_display(const std::string& program, const std::string& remedy) {
    if (platform::display_available()) return;
    fail_system(program, "no display", remedy, "X11 or Wayland");
}

std::filesystem::path unused_file(const std::filesystem::path& folder, const std::string& stem,
                                  const std::string& extension) {
    for (int number = 0;; ++number) {
        std::filesystem::path path = folder / fmt::format("{}_{:04}{}", stem, number, extension);
        // A broken link is a name that is taken.
        if (std::error_code unknown; !std::filesystem::exists(std::filesystem::symlink_status(path, unknown)))
            return path;
    }
}

}  // namespace rowland::app
