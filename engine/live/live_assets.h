#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/asset/store.h"
#include "engine/cook/recooker.h"
#include "engine/cook/registry.h"
#include "engine/lighting/light_probe.h"
#include "engine/scene/imported_scene.h"

namespace rowland::live {

struct LiveAssetSettings {
    std::string probe_mapping = "auto";              ///< of probe images
    std::optional<lighting::CaptureDome> dome{};     ///< of probe images
    bool watch = true;                               ///< whether poll() cooks `follow_also`
    std::vector<cook::Recooker::Job> follow_also{};  ///< cooked again when their sources change
    /// For scenes that are cooked on loading; empty: default_cache_folder().
    std::filesystem::path cache_folder{};
};

/// $XDG_CACHE_HOME/rowland, or ~/.cache/rowland, or rowland in the folder for temporary files if neither
/// $XDG_CACHE_HOME nor $HOME is set.
std::filesystem::path default_cache_folder();

/// The assets of a running program, from cooked files or from sources that are baked on loading. They follow their
/// files while poll() is called.
class LiveAssets {
 public:
    LiveAssets(std::shared_ptr<const cook::Registry> registry, LiveAssetSettings settings);

    /// A cooked probe, a probe recipe, or an image with the mapping and dome of the settings. Throws Error (input), as
    /// the three functions below do.
    asset::Handle<lighting::LightProbe> probe(const std::filesystem::path& path);
    /// A cooked scene, or a glTF file (load_scene()).
    asset::Handle<scene::ImportedScene> scene(const std::filesystem::path& path);
    /// All triangles of a glTF file.
    asset::Handle<scene::Mesh> mesh(const std::filesystem::path& path);
    /// An asset of the registered type `type`, cooked or from its .json source. `read` parses the cooked payload;
    /// `file` is for its messages.
    template <typename T>
    asset::Handle<T> load(const std::filesystem::path& path, const std::string& type,
                          std::function<T(std::span<const std::byte> payload, const std::string& file)> read) {
        return store_.load<T>(path.string(), [registry = registry_, path, type, read = std::move(read)](Files& files) {
            return read(payload(*registry, path, type, files), path.string());
        });
    }

    /// Call it every frame. Returns whether an asset was replaced or could not be reloaded.
    bool poll();
    /// Loads all assets again, changed or not.
    void reload_all() { store_.reload_all(); }
    /// Messages of the assets that could not be cooked or reloaded, until they can.
    std::vector<std::string> failures() const;

 private:
    using Files = std::vector<std::filesystem::path>;
    static std::vector<std::byte> payload(const cook::Registry& registry, const std::filesystem::path& path,
                                          const std::string& type, Files& files);
    friend lighting::LightProbe load_probe(const cook::Registry& registry, const std::filesystem::path& path,
                                           const std::string& mapping, Files& read_files,
                                           const std::optional<lighting::CaptureDome>& dome);

    std::string probe_mapping_;
    std::optional<lighting::CaptureDome> dome_;
    std::filesystem::path cache_folder_;
    std::shared_ptr<const cook::Registry> registry_;
    asset::Store store_;
    std::optional<cook::Recooker> recooker_;
};

/// What LiveAssets::probe() loads; adds the files it read to `read_files`. May be called from any thread. Throws Error
/// (input).
lighting::LightProbe load_probe(const cook::Registry& registry, const std::filesystem::path& path,
                                const std::string& mapping, std::vector<std::filesystem::path>& read_files,
                                const std::optional<lighting::CaptureDome>& dome = {});

/// What LiveAssets::scene() loads: a cooked .scene, or a .gltf or .glb, which is cooked first unless `cache_folder` has
/// it cooked from the same content. Adds the files it read, or whose content is in the cooked file, to `read_files`.
/// May be called from any thread. Throws Error (input).
scene::ImportedScene load_scene(const cook::Registry& registry, const std::filesystem::path& path,
                                const std::filesystem::path& cache_folder,
                                std::vector<std::filesystem::path>& read_files);

}  // namespace rowland::live
