#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/platform/debug_build.h"
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

/// Declares them. `capture_help` says what the picture shows. `options` must outlive `app`.
void add_common_options(CLI::App& app, CommonOptions& options, const std::string& capture_help);

/// The OpenColorIO config that the options name, with their display and view as its defaults. Throws Error (input).
post::OcioConfig open_ocio_config(const CommonOptions& options);

/// The values that are there, for check_outputs().
std::vector<std::filesystem::path> given(
    std::initializer_list<std::reference_wrapper<const std::optional<std::filesystem::path>>> options);

}  // namespace rowland::app
