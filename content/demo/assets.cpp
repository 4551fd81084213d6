#include "content/demo/assets.h"

#include <array>
#include <cstddef>

#include "engine/asset/container.h"
#include "engine/cook/cook_source.h"
#include "engine/core/log.h"
#include "engine/image/load.h"
#include "engine/lighting/cook.h"
#include "engine/scene/cook.h"
#include "engine/scene/gltf_import.h"
#include "modules/diffraction/cook.h"

namespace rowland::demo {

namespace {

using Files = std::vector<std::filesystem::path>;

/// What content/CMakeLists.txt cooks for the demo: source below content/, cooked file.
struct ShippedAsset {
    const char* source;
    const char* cooked;
};
constexpr std::array<ShippedAsset, 7> kShippedAssets = {{{"materials/cd.json", "cd.material"},
                                                         {"meshes/cd.json", "cd.glb"},
                                                         {"meshes/ground.json", "ground.glb"},
                                                         {"meshes/sphere.json", "sphere.glb"},
                                                         {"probes/clear_sky.json", "clear_sky.probe"},
                                                         {"probes/studio.json", "studio.probe"},
                                                         {"scenes/cabinet.json", "cabinet.glb"}}};

std::shared_ptr<const cook::Registry> make_registry() {
    auto registry = std::make_shared<cook::Registry>();
    lighting::register_cook_types(*registry);
    scene::register_cook_types(*registry);
    diffraction::register_cook_types(*registry);
    return registry;
}

std::vector<cook::Recooker::Job> shipped_jobs(const Options& options) {
    std::vector<cook::Recooker::Job> jobs;
    for (const ShippedAsset& shipped : kShippedAssets) {
        const std::filesystem::path source = options.content_folder / shipped.source;
        if (std::filesystem::exists(source)) jobs.push_back({source, options.cooked_folder / shipped.cooked});
    }
    return jobs;
}

/// The payload of a cooked file, or of a source that is baked now.
std::vector<std::byte> payload(const cook::Registry& registry, const std::filesystem::path& path,
                               const std::string& type, std::uint32_t version, Files& files) {
    files.push_back(path);
    if (path.extension() != ".json") return asset::load(path, type, version).payload;
    cook::BakedAsset baked = cook::bake_source(registry, path);
    files = std::move(baked.dependencies);
    asset::check_type(baked.asset.header, type, version, path.string());
    return std::move(baked.asset.payload);
}

lighting::LightProbe probe_from_image(const std::filesystem::path& path, const std::string& mapping) {
    const lighting::ProbeImage probe(image::load_image(path), lighting::parse_mapping(mapping), path.string());
    if (const lighting::TexelReport& report = probe.report(); report.total() > 0)
        log_warning("{}: {} NaN, {} infinite and {} negative components are treated as 0", path.string(), report.nan,
                    report.infinite, report.negative);
    return lighting::build_light_probe(probe);
}

}  // namespace

Assets::Assets(const Options& options, std::vector<std::string> handled_extensions)
    : probe_mapping_(options.probe_mapping),
      handled_extensions_(std::move(handled_extensions)),
      registry_(make_registry()) {
    if (options.watch) recooker_.emplace(*registry_, shipped_jobs(options));
}

asset::Handle<lighting::LightProbe> Assets::probe(const std::filesystem::path& path) {
    return store_.load<lighting::LightProbe>(
        path.string(), [registry = registry_, mapping = probe_mapping_, path](Files& files) {
            if (path.extension() == ".json" || path.extension() == ".probe")
                return lighting::deserialise(payload(*registry, path, "probe", lighting::kLightProbeVersion, files),
                                             path.string());
            files.push_back(path);
            return probe_from_image(path, mapping);
        });
}

asset::Handle<diffraction::CookedMaterial> Assets::material(const std::filesystem::path& path) {
    return store_.load<diffraction::CookedMaterial>(path.string(), [registry = registry_, path](Files& files) {
        return diffraction::read_cooked_material(
            payload(*registry, path, diffraction::kMaterialAssetType, diffraction::kMaterialAssetVersion, files),
            path.string());
    });
}

asset::Handle<scene::ImportedScene> Assets::scene(const std::filesystem::path& path) {
    return store_.load<scene::ImportedScene>(path.string(), [handled = handled_extensions_, path](Files& files) {
        files.push_back(path);
        scene::ImportedScene imported = scene::load_gltf(path, handled, &files);
        for (const std::string& warning : imported.warnings) log_warning("{}: {}", path.string(), warning);
        return imported;
    });
}

bool Assets::poll() {
    if (recooker_) recooker_->poll();
    return store_.poll();
}

std::vector<std::string> Assets::failures() const {
    std::vector<std::string> result = store_.failures();
    if (!recooker_) return result;
    for (std::string& failure : recooker_->failures()) result.push_back(std::move(failure));
    return result;
}

std::vector<std::filesystem::path> probe_paths(const Options& options) {
    if (options.probe) return {*options.probe};
    return {options.cooked_folder / "studio.probe", options.cooked_folder / "clear_sky.probe"};
}

std::filesystem::path default_cooked_folder() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "cooked";
}

}  // namespace rowland::demo
