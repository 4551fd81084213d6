#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/asset/store.h"
#include "engine/cook/recooker.h"
#include "engine/cook/registry.h"
#include "engine/lighting/light_probe.h"
#include "engine/scene/imported_scene.h"
#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::diffraction {

struct LiveAssetSettings {
    std::string probe_mapping = "equirect";  ///< of probe images
    /// The glTF material extensions that the renderer's materials read.
    std::vector<std::string> handled_extensions{};
    bool watch = true;                               ///< cooked assets follow their sources
    std::vector<cook::Recooker::Job> follow_also{};  ///< these, if `watch`
};

/// Assets of a program that shows gratings, each loaded by what its file is: cooked, or a source that is baked now.
/// While poll() is called they follow their files.
class LiveAssets {
 public:
    explicit LiveAssets(LiveAssetSettings settings);

    /// A cooked probe, a probe recipe, or an image with the mapping of the settings. All throw Error (input).
    asset::Handle<lighting::LightProbe> probe(const std::filesystem::path& path);
    /// A cooked material, or a material file.
    asset::Handle<CookedMaterial> material(const std::filesystem::path& path);
    /// A glTF file.
    asset::Handle<scene::ImportedScene> scene(const std::filesystem::path& path);

    /// Once a frame. True if an asset was replaced, or could not be.
    bool poll();
    /// Loads everything anew, changed or not.
    void reload_all() { store_.reload_all(); }
    /// What could not be cooked or loaded anew, and why, until it can.
    std::vector<std::string> failures() const;

 private:
    std::string probe_mapping_;
    std::vector<std::string> handled_extensions_;
    std::shared_ptr<const cook::Registry> registry_;
    asset::Store store_;
    std::optional<cook::Recooker> recooker_;
};

/// All types that probes, scenes and materials are cooked by.
std::shared_ptr<const cook::Registry> make_registry();

/// What LiveAssets::probe() loads, and the files it read. May be called from any thread. Throws Error (input).
lighting::LightProbe load_probe(const cook::Registry& registry, const std::filesystem::path& path,
                                const std::string& mapping, std::vector<std::filesystem::path>& read_files);

}  // namespace rowland::diffraction
