#include "content/demo/assets.h"

#include <fmt/format.h>

#include <array>

#include "engine/core/program.h"
#include "engine/core/system.h"
#include "modules/asset_types.h"

namespace rowland::demo {

std::vector<cook::Recooker::Job> shipped_jobs(const Options& options) {
    constexpr std::array<std::array<const char*, 2>, 8> kShipped = {{{"materials/cd.json", "cd.material"},
                                                                     {"meshes/cd.json", "cd.glb"},
                                                                     {"meshes/ground.json", "ground.glb"},
                                                                     {"meshes/sphere.json", "sphere.glb"},
                                                                     {"probes/clear_sky.json", "clear_sky.probe"},
                                                                     {"probes/night.json", "night.probe"},
                                                                     {"probes/studio.json", "studio.probe"},
                                                                     {"scenes/cabinet.glb", "cabinet.scene"}}};
    std::vector<cook::Recooker::Job> jobs;
    for (const auto& [source, cooked] : kShipped)
        if (const auto path = options.content_folder / source; std::filesystem::exists(path))
            jobs.push_back({path, options.cooked_folder / cooked});
    return jobs;
}

namespace {

/// Beside the cooked assets where these can be written, else the user's.
std::filesystem::path cache_folder(const Options& options) {
    return takes_files(options.cooked_folder) ? options.cooked_folder : live::default_cache_folder();
}

}  // namespace

LiveAssets open_assets(const Options& options) {
    std::optional<lighting::CaptureDome> dome;
    if (options.dome_radius_m > 0.0) dome = {.radius_m = options.dome_radius_m};
    return {modules::asset_types(),
            {.probe_mapping = options.probe_mapping,
             .dome = dome,
             .watch = options.watch,
             .follow_also = shipped_jobs(options),
             .cache_folder = cache_folder(options)}};
}

std::vector<std::filesystem::path> probe_paths(const Options& options) {
    if (options.probe) return {*options.probe};
    std::vector<std::filesystem::path> paths;
    for (const char* name : {"interior", "forest", "city", "courtyard", "night", "studio", "sunrise", "sunset"})
        if (const auto path = options.cooked_folder / fmt::format("captured_{}.probe", name);
            std::filesystem::exists(path))
            paths.push_back(path);
    for (const char* name : {"studio", "clear_sky", "night"})
        paths.push_back(options.cooked_folder / fmt::format("{}.probe", name));
    return paths;
}

std::filesystem::path default_cooked_folder() {
    return program_prefix() / "cooked";
}

}  // namespace rowland::demo
