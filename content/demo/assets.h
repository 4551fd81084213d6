#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "content/demo/options.h"
#include "modules/diffraction/live_assets.h"

namespace rowland::demo {

using diffraction::LiveAssets;

/// The demo's assets; the shipped ones are recooked when their sources change. `handled_extensions`: the glTF material
/// extensions that the renderer's materials read.
LiveAssets open_assets(const Options& options, std::vector<std::string> handled_extensions);

/// What content/CMakeLists.txt cooks for the demo: sources and cooked files.
std::vector<cook::Recooker::Job> shipped_jobs(const Options& options);

/// The probe of the command line, or all shipped ones.
std::vector<std::filesystem::path> probe_paths(const Options& options);

/// The folder of cooked assets if the command line names none: ../cooked beside the program.
std::filesystem::path default_cooked_folder();

}  // namespace rowland::demo
