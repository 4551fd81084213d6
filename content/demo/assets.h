#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "content/demo/options.h"
#include "engine/live/live_assets.h"

namespace rowland::demo {

using live::LiveAssets;

/// The demo's assets. The shipped ones are cooked again and reloaded when their sources change.
LiveAssets open_assets(const Options& options);

/// Source and cooked file of each asset that content/CMakeLists.txt cooks for the demo; without missing sources.
std::vector<cook::Recooker::Job> shipped_jobs(const Options& options);

/// The probe of the command line, or all cooked ones: captures where there are any, then procedural ones.
std::vector<std::filesystem::path> probe_paths(const Options& options);

/// The folder of cooked assets if the command line names none: `../cooked`, relative to the program's folder.
std::filesystem::path default_cooked_folder();

}  // namespace rowland::demo
