#include "editor/inspector/cooked_surfaces.h"

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

/// The same for a film on a material of a scene. Only whether a texture varies the thickness matters, not which one.
std::string bake_key(Json extension, std::size_t material) {
    extension.erase("iridescenceFactor");
    extension.erase("iridescenceTexture");
    const char* const thickness = "iridescenceThicknessTexture";
    if (extension.contains(thickness)) extension[thickness] = true;
    return fmt::format("{} {}", material, extension.dump());
}

/// The index in textures_of() of a texture of the document. Throws Error (input) if there is none.
std::size_t texture_index(std::size_t index, const MaterialSource& source, const scene::ImportedScene& scene,
                          const char* pointer) {
    if (source.textures.find(index)) return index - NewTextures::kFirst + scene.textures.size();
    scene::require_texture(scene, index, source.name, pointer);
    return index;
}

}  // namespace

std::shared_ptr<const CookedSurface> SurfaceCook::cook(const MaterialSource& source, std::size_t material) {
    if (const auto* grating = source.grating())
        return std::make_shared<const CookedSurface>(cook_grating(*grating, source));
    return std::make_shared<const CookedSurface>(CookedSurface{.film = cook_film(source, material)});
}

CookedSurface SurfaceCook::cook_grating(const diffraction::GltfGrating& grating, const MaterialSource& source) {
    std::shared_ptr<const diffraction::GrooveMap> grooves;
    diffraction::Material drawable = grating.material;
    if (!scene_) diffraction::require_baked_grooves(drawable.grating, source.name);
    if (scene_ && grating.groove_texture) {
        diffraction::GrooveTexture use = *grating.groove_texture;
        use.index = static_cast<int>(
            texture_index(static_cast<std::size_t>(use.index), source, scene_->imported, "/grooveTexture"));
        const auto scene = textures_of(source);
        render::SurfaceTextures textures(*scene);
        grooves = std::make_shared<const diffraction::GrooveMap>(use, textures, source.name, "/grooveTexture");
    }
    if (scene_)
        drawable = diffraction::drawable_material(grating, grooves ? &grooves->pitches() : nullptr, source.name, {});
    return {.material = baked(tables_->gratings, bake_key(source.json, drawable, grooves.get()),
                              [&] { return diffraction::bake_material(with_efficiencies(drawable, source.name)); }),
            .grooves = grooves,
            .groove_rotation = grating.groove_rotation,
            .has_base = grating.has_base};
}

DrawnFilm SurfaceCook::cook_film(const MaterialSource& source, std::size_t material) {
    const auto bake = [&](const thin_film::FilmMaterial& film, const std::string& key) {
        return baked(tables_->films, key, [&] { return thin_film::CookedFilm{film, thin_film::bake_film(film)}; });
    };
    if (const auto* film = std::get_if<thin_film::FilmMaterial>(&source.parsed))
        return {.cooked = bake(*film, source.json.dump())};
    DrawnFilm drawn{.in_scene = std::get<thin_film::GltfIridescence>(source.parsed), .textures = textures_of(source)};
    for (const auto& [use, pointer] : {std::pair(&drawn.in_scene->factor_texture, "/iridescenceTexture"),
                                       {&drawn.in_scene->thickness_texture, "/iridescenceThicknessTexture"}})
        if (*use) (*use)->texture = texture_index((*use)->texture, source, scene_->imported, pointer);
    const auto film =
        thin_film::film_material(*drawn.in_scene, scene_->imported.materials.at(material), source.name, {});
    if (film) drawn.cooked = bake(*film, bake_key(source.json, material));
    return drawn;
}

/// The textures of the scene, then the new ones.
std::shared_ptr<const scene::ImportedScene> SurfaceCook::textures_of(const MaterialSource& source) const {
    auto all = std::make_shared<scene::ImportedScene>();
    all->images = scene_->imported.images;
    all->textures = scene_->imported.textures;
    for (const auto& added : source.textures.all()) {
        all->textures.push_back({.image = all->images.size()});
        all->images.push_back(added->picture);
    }
    return all;
}

template <typename Cooked, typename Bake>
std::shared_ptr<const Cooked> SurfaceCook::baked(Baked<Cooked>& all, const std::string& key, const Bake& bake) {
    {
        const std::scoped_lock guard(tables_->lock);
        if (auto present = all[key].lock()) return present;
    }
    auto made = std::make_shared<const Cooked>(bake());
    const std::scoped_lock guard(tables_->lock);
    all[key] = made;
    return made;
}

void SceneSurfaces::reset() {
    others_.reset();
    all_.clear();
    sources_.clear();
}

void SceneSurfaces::want_others(const Document& document, const std::shared_ptr<SurfaceCook>& cook) {
    std::vector<Source> others(all_.size());
    bool any = false;
    for (std::size_t i = 0; i < others.size(); ++i) {
        if (i != document.chosen()) others[i] = document.accepted(i);
        any = any || others[i];
    }
    others_.want(any ? std::optional(others) : std::nullopt,
                 [cook, others](const std::stop_token& stop, const auto& publish) -> std::optional<Cooked> {
                     Cooked made{others, CookedSurfaces(others.size()), {}};
                     for (std::size_t i = 0; i < others.size(); ++i) {
                         if (!others[i]) continue;
                         if (stop.stop_requested()) return std::nullopt;
                         try {
                             made.surfaces[i] = cook->cook(*others[i], i);
                             publish(made);
                         } catch (const std::exception& error) {
                             made.failures.emplace_back(error.what());
                         }
                     }
                     return made;
                 });
}

bool SceneSurfaces::update(const Document& document, const std::shared_ptr<SurfaceCook>& cook, const Surface& chosen) {
    all_.resize(document.material_count());
    sources_.resize(all_.size());
    want_others(document, cook);
    bool news = false;
    const auto take = [&](std::size_t i, const Source& source, const Surface& surface) {
        if (!surface || source != document.accepted(i) || sources_[i] == source) return;
        sources_[i] = source;
        all_[i] = surface;
        news = true;
    };
    if (others_.poll().value) {
        const Cooked& made = *others_.value();
        if (!others_.busy()) failures_ = made.failures;
        for (std::size_t i = 0; i < std::min(all_.size(), made.sources.size()); ++i)
            take(i, made.sources[i], made.surfaces[i]);
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
