#include "editor/inspector/cook_grating.h"

#include <fmt/format.h>

#include "engine/render/surface_textures.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::inspector {

namespace {

/// What decides the tables: all but the direction of the grooves on the mesh.
std::string bake_key(Json extension, const diffraction::GrooveMap* grooves) {
    extension.erase("grooveRotation");
    extension.erase("grooveTexture");
    std::string key = extension.dump();
    if (grooves != nullptr) key += fmt::format(" {} {}", grooves->smallest_pitch(), grooves->largest_pitch());
    return key;
}

}  // namespace

std::shared_ptr<const CookedGrating> GratingCook::cook(const MaterialSource& source) {
    if (!scene_) {
        diffraction::require_baked_grooves(source.material.grating, source.name);
        return std::make_shared<const CookedGrating>(
            CookedGrating{.material = baked(source.material, bake_key(source.json, nullptr)), .grooves = nullptr});
    }
    const auto grooves = groove_map(source);
    const diffraction::Material material = diffraction::drawable_material(source.gltf, grooves.get(), source.name, {});
    return std::make_shared<const CookedGrating>(
        CookedGrating{.material = baked(material, bake_key(source.json, grooves.get())),
                      .grooves = grooves,
                      .groove_rotation = source.gltf.groove_rotation,
                      .has_base = source.gltf.has_base});
}

std::shared_ptr<const diffraction::GrooveMap> GratingCook::groove_map(const MaterialSource& source) const {
    if (!source.gltf.groove_texture) return nullptr;
    diffraction::GrooveTexture use = *source.gltf.groove_texture;
    scene::ImportedScene alone;
    if (source.groove_picture) {
        alone.images = {source.groove_picture->picture};
        alone.textures.resize(1);
        use.index = 0;
    }
    render::SurfaceTextures textures(source.groove_picture ? alone : scene_->imported);
    return std::make_shared<const diffraction::GrooveMap>(use, textures, source.name, "/grooveTexture");
}

std::shared_ptr<const diffraction::CookedMaterial> GratingCook::baked(const diffraction::Material& material,
                                                                      const std::string& key) {
    {
        const std::scoped_lock guard(lock_);
        if (auto present = baked_[key].lock()) return present;
    }
    auto made = std::make_shared<const diffraction::CookedMaterial>(diffraction::bake_material(material));
    const std::scoped_lock guard(lock_);
    baked_[key] = made;
    return made;
}

}  // namespace rowland::inspector
