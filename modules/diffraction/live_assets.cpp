#include "modules/diffraction/live_assets.h"

#include <cstddef>
#include <utility>

#include "engine/asset/container.h"
#include "engine/cook/cook_source.h"
#include "engine/core/log.h"
#include "engine/lighting/cook.h"
#include "engine/scene/cook.h"
#include "engine/scene/gltf_import.h"
#include "modules/diffraction/cook.h"

namespace rowland::diffraction {

namespace {

using Files = std::vector<std::filesystem::path>;

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

}  // namespace

std::shared_ptr<const cook::Registry> make_registry() {
    auto registry = std::make_shared<cook::Registry>();
    lighting::register_cook_types(*registry);
    scene::register_cook_types(*registry);
    diffraction::register_cook_types(*registry);
    return registry;
}

lighting::LightProbe load_probe(const cook::Registry& registry, const std::filesystem::path& path,
                                const std::string& mapping, std::vector<std::filesystem::path>& read_files) {
    if (path.extension() == ".json" || path.extension() == ".probe")
        return lighting::deserialise(payload(registry, path, "probe", lighting::kLightProbeVersion, read_files),
                                     path.string());
    read_files.push_back(path);
    return lighting::build_light_probe(lighting::load_probe_image(path, lighting::parse_mapping(mapping)));
}

LiveAssets::LiveAssets(LiveAssetSettings settings)
    : probe_mapping_(std::move(settings.probe_mapping)),
      handled_extensions_(std::move(settings.handled_extensions)),
      registry_(make_registry()) {
    if (settings.watch) recooker_.emplace(*registry_, std::move(settings.follow_also));
}

asset::Handle<lighting::LightProbe> LiveAssets::probe(const std::filesystem::path& path) {
    return store_.load<lighting::LightProbe>(path.string(),
                                             [registry = registry_, mapping = probe_mapping_, path](Files& files) {
                                                 return load_probe(*registry, path, mapping, files);
                                             });
}

asset::Handle<CookedMaterial> LiveAssets::material(const std::filesystem::path& path) {
    return store_.load<CookedMaterial>(path.string(), [registry = registry_, path](Files& files) {
        return read_cooked_material(payload(*registry, path, kMaterialAssetType, kMaterialAssetVersion, files),
                                    path.string());
    });
}

asset::Handle<scene::ImportedScene> LiveAssets::scene(const std::filesystem::path& path) {
    return store_.load<scene::ImportedScene>(path.string(), [handled = handled_extensions_, path](Files& files) {
        files.push_back(path);
        scene::ImportedScene imported = scene::load_gltf(path, handled, &files);
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

}  // namespace rowland::diffraction
