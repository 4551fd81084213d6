#include "engine/live/live_assets.h"

#include <utility>

#include "engine/asset/container.h"
#include "engine/cook/cook_source.h"
#include "engine/core/check.h"
#include "engine/core/log.h"
#include "engine/core/system.h"
#include "engine/scene/cook.h"
#include "engine/scene/gltf_import.h"

namespace rowland::live {

namespace {

constexpr const char* kScenes = "scenes";  ///< folder of cooked scenes in the cache

}  // namespace

std::vector<std::byte> LiveAssets::payload(const cook::Registry& registry, const std::filesystem::path& path,
                                           const std::string& type, Files& files) {
    const cook::AssetType* known = registry.find(type);
    ROWLAND_CHECK(known != nullptr, "assets are loaded by a registered type: " + type);
    files.push_back(path);
    if (path.extension() != ".json") return asset::load(path, type, known->version).payload;
    cook::BakedAsset baked = cook::bake_source(registry, path);
    files = std::move(baked.dependencies);
    asset::check_type(baked.asset.header, type, known->version, path.string());
    return std::move(baked.asset.payload);
}

std::filesystem::path default_cache_folder() {
    if (const auto folder = cache_folder()) return *folder / "rowland";
    return std::filesystem::temp_directory_path() / "rowland";
}

lighting::LightProbe load_probe(const cook::Registry& registry, const std::filesystem::path& path,
                                const std::string& mapping, std::vector<std::filesystem::path>& read_files,
                                const std::optional<lighting::CaptureDome>& dome) {
    if (path.extension() == ".json" || path.extension() == ".probe")
        return lighting::deserialise(LiveAssets::payload(registry, path, "probe", read_files), path.string());
    read_files.push_back(path);
    lighting::LightProbeSettings settings;
    settings.dome = dome;
    return lighting::build_light_probe(lighting::load_probe_image(path, lighting::parse_mapping(mapping)), settings);
}

LiveAssets::LiveAssets(std::shared_ptr<const cook::Registry> registry, LiveAssetSettings settings)
    : probe_mapping_(std::move(settings.probe_mapping)),
      dome_(settings.dome),
      cache_folder_(settings.cache_folder.empty() ? default_cache_folder() : std::move(settings.cache_folder)),
      registry_(std::move(registry)) {
    if (settings.watch)
        recooker_.emplace(*registry_, std::move(settings.follow_also), cook::parts_folder(cache_folder_ / kScenes));
}

asset::Handle<lighting::LightProbe> LiveAssets::probe(const std::filesystem::path& path) {
    return store_.load<lighting::LightProbe>(
        path.string(), [registry = registry_, mapping = probe_mapping_, dome = dome_, path](Files& files) {
            return load_probe(*registry, path, mapping, files, dome);
        });
}

scene::ImportedScene load_scene(const cook::Registry& registry, const std::filesystem::path& path,
                                const std::filesystem::path& cache_folder,
                                std::vector<std::filesystem::path>& read_files) {
    const bool cooked = path.extension() == ".scene";
    const std::filesystem::path file =
        cooked ? path : cook::cook_once(registry, path, cache_folder / kScenes, read_files);
    if (cooked) read_files.push_back(path);
    const cook::AssetType* type = registry.find(scene::kSceneAssetType);
    ROWLAND_CHECK(type != nullptr, "scenes are loaded with their type");
    const std::vector<std::byte> payload = asset::load(file, type->name, type->version).payload;
    scene::ImportedScene imported = scene::read_cooked_scene(payload, path.string(), registry.gltf_extension_names());
    for (const std::string& warning : imported.warnings) log_warning("{}: {}", path.string(), warning);
    return imported;
}

asset::Handle<scene::ImportedScene> LiveAssets::scene(const std::filesystem::path& path) {
    return store_.load<scene::ImportedScene>(path.string(),
                                             [registry = registry_, cache = cache_folder_, path](Files& files) {
                                                 return load_scene(*registry, path, cache, files);
                                             });
}

asset::Handle<scene::Mesh> LiveAssets::mesh(const std::filesystem::path& path) {
    return store_.load<scene::Mesh>(path.string(), [registry = registry_, path](Files& files) {
        const scene::ImportedScene imported = scene::load_gltf(path, registry->gltf_extension_names(), &files);
        for (const std::string& warning : imported.warnings) log_warning("{}: {}", path.string(), warning);
        return scene::merge_instances(imported);
    });
}

bool LiveAssets::poll() {
    if (recooker_) recooker_->poll();
    return store_.poll();
}

std::vector<std::string> LiveAssets::failures() const {
    std::vector<std::string> result = store_.failures();
    if (!recooker_) return result;
    for (std::string& failure : recooker_->failures()) result.push_back(std::move(failure));
    return result;
}

}  // namespace rowland::live
