#include "editor/inspector/foil_wall.h"

#include <optional>
#include <utility>

#include "engine/core/error.h"

namespace rowland::inspector {

namespace foil = diffraction::foil;

namespace {

constexpr int kHeight_px = 160;

/// The thumbnails that are not known yet. Those that are refused stay as they were: the chosen type's card says why.
template <typename All, typename Publish>
std::optional<All> make_thumbnails(All all, const std::vector<std::string>& keys, const std::vector<Json>& recipes,
                                   const FoilPictures& pictures, const std::string& file, const std::stop_token& stop,
                                   const Publish& publish) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (stop.stop_requested()) return std::nullopt;
        if (all[i].key == keys[i]) continue;
        try {
            const foil::Recipe recipe = foil::parse_foil_recipe(nlohmann::json(recipes[i]), file);
            all[i].thumbnail =
                std::make_shared<const foil::Thumbnail>(recipe, pictures.of(recipe, 2 * kHeight_px), file, kHeight_px);
            all[i].key = keys[i];
        } catch (const Error&) {
            continue;
        }
        publish(all);
    }
    return all;
}

}  // namespace

bool FoilWall::update(const FoilRecipe& recipe, bool may_begin) {
    if (may_begin && recipe.refusal().empty()) {
        std::vector<Json> recipes;
        std::vector<std::string> keys;
        for (const std::string_view type : foil::foil_type_names()) {
            recipes.push_back(recipe.with_type(type));
            keys.push_back(recipe.key(recipes.back()));
        }
        if (!made_.wants(keys)) {
            All before = made_.value() != nullptr ? *made_.value() : All(keys.size());
            made_.want(keys, [keys, recipes, all = std::move(before), pictures = recipe.pictures(),
                              file = recipe.name()](const std::stop_token& stop, const auto& publish) {
                return make_thumbnails(all, keys, recipes, *pictures, file, stop, publish);
            });
        }
    }
    return made_.poll().value;
}

void FoilWall::draw(const glm::quat& tilt) {
    if (made_.value() == nullptr) return;
    const All& all = *made_.value();
    drawn_.resize(all.size());
    for (std::size_t type = 0; type < all.size(); ++type) {
        const foil::Thumbnail* const thumbnail = all[type].thumbnail.get();
        Drawn& drawn = drawn_[type];
        if (thumbnail == nullptr || (drawn.thumbnail == all[type].thumbnail && drawn.tilt == tilt)) continue;
        const gpu::TextureDesc desc{
            .format = gpu::Format::RGBA8, .width = thumbnail->width(), .height = thumbnail->height()};
        if (drawn.texture.id() == 0 || drawn.texture.desc() != desc) drawn.texture = gpu::Texture(desc);
        rgba_.resize(std::size_t{4} * static_cast<std::size_t>(desc.width) * static_cast<std::size_t>(desc.height));
        thumbnail->draw(glm::mat3_cast(tilt), rgba_);
        drawn.texture.upload(std::span<const std::uint8_t>(rgba_));
        drawn.thumbnail = all[type].thumbnail;
        drawn.tilt = tilt;
    }
}

const gpu::Texture* FoilWall::picture(std::size_t type) const {
    return type < drawn_.size() && drawn_[type].thumbnail ? &drawn_[type].texture : nullptr;
}

}  // namespace rowland::inspector
