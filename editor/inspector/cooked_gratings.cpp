#include "editor/inspector/cooked_gratings.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/file.h"
#include "engine/render/surface_textures.h"
#include "modules/diffraction/asset/groove_pitches.h"

namespace rowland::inspector {

namespace {

/// The inputs of the tables: everything but the direction of the grooves on the mesh.
std::string bake_key(Json extension, const diffraction::Material& material, const diffraction::GrooveMap* grooves) {
    extension.erase("grooveRotation");
    extension.erase("grooveTexture");
    std::string key = extension.dump();
    if (grooves != nullptr) key += fmt::format(" {} {}", grooves->pitches().smallest, grooves->pitches().largest);
    for (const auto& [file, text] : diffraction::named_texts(nlohmann::json(extension), material))
        key += ' ' + Hasher().text(text).digest().hex();
    return key;
}

}  // namespace

std::shared_ptr<const CookedGrating> GratingCook::cook(const MaterialSource& source) {
    if (!scene_) {
        diffraction::require_baked_grooves(source.material.grating, source.name);
        return std::make_shared<const CookedGrating>(CookedGrating{
            .material = baked(source.material, bake_key(source.json, source.material, nullptr)), .grooves = nullptr});
    }
    const auto grooves = groove_map(source);
    const diffraction::Material material =
        diffraction::drawable_material(source.gltf, grooves ? &grooves->pitches() : nullptr, source.name, {});
    return std::make_shared<const CookedGrating>(
        CookedGrating{.material = baked(material, bake_key(source.json, material, grooves.get())),
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

void SceneGratings::reset() {
    others_.reset();
    all_.clear();
    sources_.clear();
}

void SceneGratings::want_others(const Document& document, const std::shared_ptr<GratingCook>& cook) {
    std::vector<Source> others(all_.size());
    bool any = false;
    for (std::size_t i = 0; i < others.size(); ++i) {
        if (i != document.chosen()) others[i] = document.accepted(i);
        any = any || others[i];
    }
    others_.want(any ? std::optional(others) : std::nullopt,
                 [cook, others](const std::stop_token& stop, const auto& publish) -> std::optional<Cooked> {
                     Cooked made{others, Gratings(others.size()), {}};
                     for (std::size_t i = 0; i < others.size(); ++i) {
                         if (!others[i]) continue;
                         if (stop.stop_requested()) return std::nullopt;
                         try {
                             made.gratings[i] = cook->cook(*others[i]);
                             publish(made);
                         } catch (const std::exception& error) {
                             made.failures.emplace_back(error.what());
                         }
                     }
                     return made;
                 });
}

bool SceneGratings::update(const Document& document, const std::shared_ptr<GratingCook>& cook, const Grating& chosen) {
    all_.resize(document.material_count());
    sources_.resize(all_.size());
    want_others(document, cook);
    bool news = false;
    const auto take = [&](std::size_t i, const Source& source, const Grating& grating) {
        if (!grating || source != document.accepted(i) || sources_[i] == source) return;
        sources_[i] = source;
        all_[i] = grating;
        news = true;
    };
    if (others_.poll().value) {
        const Cooked& made = *others_.value();
        if (!others_.busy()) failures_ = made.failures;
        for (std::size_t i = 0; i < std::min(all_.size(), made.sources.size()); ++i)
            take(i, made.sources[i], made.gratings[i]);
    }
    take(document.chosen(), document.accepted(), chosen);
    for (std::size_t i = 0; i < all_.size(); ++i) {
        if (document.accepted(i)) continue;
        news = news || all_[i];
        all_[i] = nullptr;
        sources_[i] = nullptr;
    }
    return news;
}

}  // namespace rowland::inspector
