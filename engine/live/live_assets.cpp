#include "engine/live/live_assets.h"

#include <utility>

#include "engine/asset/container.h"
#include "engine/cook/cook_source.h"
#include "engine/core/check.h"
#include "engine/core/log.h"
#include "engine/scene/gltf_import.h"

namespace rowland::live {

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

lighting::LightProbe load_probe(const cook::Registry& registry, const std::filesystem::path& path,
                                const std::string& mapping, std::vector<std::filesystem::path>& read_files) {
    if (path.extension() == ".json" || path.extension() == ".probe")
        return lighting::deserialise(LiveAssets::payload(registry, path, "probe", read_files), path.string());
    read_files.push_back(path);
    return lighting::build_light_probe(lighting::load_probe_image(path, lighting::parse_mapping(mapping)));
}

LiveAssets::LiveAssets(std::shared_ptr<const cook::Registry> registry, LiveAssetSettings settings)
    : probe_mapping_(std::move(settings.probe_mapping)), registry_(std::move(registry)) {
    if (settings.watch) recooker_.emplace(*registry_, std::move(settings.follow_also));
}

asset::Handle<lighting::LightProbe> LiveAssets::probe(const std::filesystem::path& path) {
    return store_.load<lighting::LightProbe>(path.string(),
                                             [registry = registry_, mapping = probe_mapping_, path](Files& files) {
                                                 return load_probe(*registry, path, mapping, files);
                                             });
}

asset::Handle<scene::ImportedScene> LiveAssets::scene(const std::filesystem::path& path) {
    return store_.load<scene::ImportedScene>(path.string(), [registry = registry_, path](Files& files) {
        files.push_back(path);
        scene::ImportedScene imported = scene::load_gltf(path, registry->gltf_extension_names(), &files);
        for (const std::string& warning : imported.warnings) log_warning("{}: {}", path.string(), warning);
        return imported;
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
