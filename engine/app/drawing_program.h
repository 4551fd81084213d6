#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/platform/gl_context.h"
#include "engine/post/ocio_config.h"

namespace rowland::app {

/// The options of every program that draws.
struct CommonOptions {
    std::optional<std::filesystem::path> probe;
    std::string probe_mapping = "auto";
    std::optional<std::filesystem::path> ocio_config;
    std::string display;                           ///< of the OpenColorIO config; empty: its default
    std::string view;                              ///< of the display; empty: its default
    std::optional<std::filesystem::path> capture;  ///< PNG
    std::filesystem::path content_folder;          ///< sources: materials, probes, meshes, scenes
    bool gl_debug = platform::debug_build();       ///< the driver's messages are logged
};

/// Declares these options in `app`. `capture_help` is the help of --capture. `options` must outlive `app`.
void add_common_options(CLI::App& app, CommonOptions& options, const std::string& capture_help);

/// The OpenColorIO config that the options name, with their display and view as its defaults. Throws Error (input).
post::OcioConfig open_ocio_config(const CommonOptions& options);

/// The values of the options that were given, for check_outputs().
std::vector<std::filesystem::path> given(
    std::initializer_list<std::reference_wrapper<const std::optional<std::filesystem::path>>> options);

/// Runs `body(renderer)` in an OpenGL context without a window. `renderer` is the device's name. `debug`: the driver's
/// messages are logged. Throws Error (system) without OpenGL 4.5 core.
void render_offscreen(bool debug, const std::function<void(const std::string& renderer)>& body);

/// Throws Error (system) if no display can be reached; `remedy` says how `program` runs without one.
void require_display(const std::string& program, const std::string& remedy);

/// The first unused path among screenshot_0000.png, screenshot_0001.png, … in `folder`, for the stem "screenshot" and
/// the extension ".png".
std::filesystem::path unused_file(const std::filesystem::path& folder, const std::string& stem,
                                  const std::string& extension);

}  // namespace rowland::app
