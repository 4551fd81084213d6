#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "content/demo/options.h"
#include "engine/asset/store.h"
#include "engine/cook/recooker.h"
#include "engine/cook/registry.h"
#include "engine/lighting/light_probe.h"
#include "engine/scene/imported_scene.h"
#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::demo {

/// The demo's assets, each loaded by what its file is: cooked, or a source that is baked now. While poll() is called
/// they follow their files, and the shipped cooked assets follow their sources.
class Assets {
 public:
    /// `handled_extensions`: the glTF material extensions that the renderer's materials read.
    Assets(const Options& options, std::vector<std::string> handled_extensions);

    /// A cooked probe, a probe recipe, or an image with the mapping of the options. All throw Error (input).
    asset::Handle<lighting::LightProbe> probe(const std::filesystem::path& path);
    /// A cooked material, or a material file.
    asset::Handle<diffraction::CookedMaterial> material(const std::filesystem::path& path);
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

/// The probe of the command line, or all shipped ones.
std::vector<std::filesystem::path> probe_paths(const Options& options);

/// The folder that holds the cooked assets when the command line names none: ../cooked beside the program.
std::filesystem::path default_cooked_folder();

}  // namespace rowland::demo
