#include "editor/inspector/foil_studio.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "modules/diffraction/asset/gltf_extension.h"

namespace rowland::inspector {

namespace foil = diffraction::foil;

namespace {

constexpr int kSmall_px = 512;   ///< of the card while a control moves
constexpr int kWall_px = 256;    ///< of a card in the wall
constexpr double kTurn_s = 7.0;  ///< of a hand's tilt

constexpr float kCard_m = 0.116F;  ///< height of the wall, and the longer side of a card alone
constexpr float kPitch = 1.07F;    ///< distance of the cards of the wall over their size

struct Stopped {};

/// All that the card of a recipe depends on.
std::string card_key(const FoilRecipe& recipe, const Json& json) {
    return json.dump() + std::to_string(recipe.pictures()->revision());
}

/// `most`: texels along the longer side; none: the recipe's. Throws Error (input), and Stopped.
std::shared_ptr<const FoilCard> make_card(foil::Recipe recipe, const FoilPictures& pictures, const std::string& file,
                                          const SurfaceCook& tables, const std::stop_token& stop,
                                          std::optional<int> most) {
    FoilCard card;
    card.full = !most || *most >= recipe.texture_px;
    if (card.full) most.reset();
    recipe.texture_px = most.value_or(recipe.texture_px);
    const auto check_stop = [&] {
        if (stop.stop_requested()) throw Stopped();
    };
    card.glb = foil::make_card(recipe, pictures.of(recipe, most), file, check_stop);
    check_stop();
    card.scene = load_scene_object(card.glb, file);
    SurfaceCook cook(card.scene, &tables);
    for (const scene::MaterialDescription& material : card.scene->imported.materials) {
        card.surfaces.emplace_back();
        const auto extension = material.extensions.find(diffraction::kGltfExtension);
        if (extension == material.extensions.end()) continue;
        check_stop();
        const auto source = accept_extension(Json(extension->second), file, {});
        card.surfaces.back() = cook.cook(*source, card.surfaces.size() - 1);
    }
    return std::make_shared<const FoilCard>(std::move(card));
}

}  // namespace

bool FoilWall::update(const FoilRecipe& recipe, const SurfaceCook& tables, bool may_begin) {
    const std::vector<std::string_view> types = foil::foil_type_names();
    if (may_begin && recipe.refusal().empty()) {
        std::vector<std::string> keys;
        for (const std::string_view type : types) keys.push_back(card_key(recipe, recipe.with_type(type)));
        if (!cards_.wants(keys)) {
            All before = cards_.value() != nullptr ? *cards_.value() : All(types.size());
            std::vector<Json> recipes;
            for (const std::string_view type : types) recipes.push_back(recipe.with_type(type));
            cards_.want(keys,
                        [keys, recipes, all = std::move(before), pictures = recipe.pictures(), file = recipe.name(),
                         &tables](const std::stop_token& stop, const auto& publish) mutable -> std::optional<All> {
                            for (std::size_t i = 0; i < keys.size(); ++i) {
                                if (all[i].key == keys[i]) continue;
                                try {
                                    const foil::Recipe parsed =
                                        foil::parse_foil_recipe(nlohmann::json(recipes[i]), file);
                                    all[i] = {keys[i], make_card(parsed, *pictures, file, tables, stop, kWall_px)};
                                } catch (const Stopped&) {
                                    return std::nullopt;
                                } catch (const Error&) {
                                    continue;  // the last one stays; what is chosen says why
                                }
                                publish(all);
                            }
                            return all;
                        });
        }
    }
    if (!cards_.poll().value) return false;
    arrange();
    return true;
}

void FoilWall::arrange() {
    const All& all = *cards_.value();
    SceneObject scene;
    SceneUpload parts;
    CookedSurfaces surfaces;
    std::map<const FoilCard*, SceneUpload> uploads;
    for (std::size_t type = 0; type < all.size(); ++type) {
        const FoilCard* card = all[type].card.get();
        if (card == nullptr) continue;
        auto& upload = uploads[card];
        const auto known = uploads_.find(card);
        upload = known != uploads_.end() ? known->second : inspector::upload(*card->scene);
        const scene::Bounds box = upload.meshes.front().gpu->bounds();
        card_m_ = glm::vec2(box.maximum - box.minimum);
        // The front is the card's first mesh and material.
        const auto column = static_cast<float>(type % kColumns) - 0.5F * (kColumns - 1);
        const auto row = static_cast<float>(type / kColumns) - 0.5F * (kRows - 1);
        const glm::vec2 step = kPitch * card_m_;
        const std::size_t index = parts.meshes.size();
        scene::ImportedNode& node = scene.imported.nodes.emplace_back();
        node.local.translation = resting_tilt() * glm::vec3(column * step.x, -row * step.y, 0.0F);
        scene::ImportedInstance& instance = scene.imported.instances.emplace_back();
        instance.mesh = instance.node = index;
        instance.material = index;
        parts.meshes.push_back(upload.meshes.front());
        parts.materials.push_back(upload.materials.front());
        surfaces.push_back(card->surfaces.front());
    }
    uploads_ = std::move(uploads);
    // The wall fills the height of the picture.
    scene.fit.scale = glm::vec3(kCard_m / (static_cast<float>(kRows) * kPitch * card_m_.y));
    object_ = std::make_shared<const PreviewObject>(PreviewObject{
        PreviewShape::Scene, std::move(parts), std::make_shared<const SceneObject>(std::move(scene)), true});
    surfaces_ = std::move(surfaces);
}

scene::Camera FoilWall::camera() {
    return card_camera(0.5F * kCard_m / std::tan(0.5F * opening_camera().vertical_field_of_view));
}

glm::ivec2 FoilWall::size(float width) const {
    const float height = card_m_.x > 0.0F ? width * card_m_.y / card_m_.x : width;
    return {std::lround(kColumns * kPitch * width), std::lround(kRows * kPitch * height)};
}

WallCell FoilWall::cell(std::size_t type) const {
    const glm::vec2 count(kColumns, kRows);
    const glm::vec2 corner(type % kColumns, type / kColumns);
    return {corner / count, (corner + 1.0F) / count};
}

void FoilStudio::advance(float seconds) {
    if (!moves()) return;
    // A slow frame does not let the card jump.
    phase_ += std::min(static_cast<double>(seconds), 0.25) / kTurn_s;
    phase_ -= std::floor(phase_);
}

void FoilStudio::want_card() {
    std::string key = card_key(recipe_, recipe_.json());
    if (card_.wants(key)) return;
    failure_.clear();
    card_.want(
        std::move(key),
        [this_recipe = recipe_.accepted(), pictures = recipe_.pictures(), file = recipe_.name(), tables = &tables_](
            const std::stop_token& stop, const auto& publish) -> std::optional<std::shared_ptr<const FoilCard>> {
            try {
                auto small = make_card(this_recipe, *pictures, file, *tables, stop, kSmall_px);
                if (small->full) return small;
                publish(small);
                return make_card(this_recipe, *pictures, file, *tables, stop, std::nullopt);
            } catch (const Stopped&) {
                return std::nullopt;
            }
        });
}

bool FoilStudio::update() {
    if (recipe_.refusal().empty()) want_card();
    const auto change = card_.poll();
    bool news = change.value || !change.failure.empty();
    if (!change.failure.empty()) failure_ = change.failure;
    if (change.value) {
        failure_.clear();
        const FoilCard& card = **card_.value();
        news = messages_.attempt([&] {
            object_ = std::make_shared<const PreviewObject>(
                PreviewObject{PreviewShape::Scene, upload(*card.scene), card.scene, true});
            surfaces_ = card.surfaces;
        });
    }
    write_card();
    return wall_.update(recipe_, tables_, !card_.busy()) || news;
}

const char* FoilStudio::shown() const {
    if (!object_ || !card_.current()) return "none";
    return (*card_.value())->full ? "full" : "small";
}

const Field& FoilStudio::dropped_field() const {
    const auto fields = recipe_.fields();
    const auto found = std::ranges::find(fields, drop_on, &Field::pointer);
    return found != fields.end() ? *found : fields.front();
}

void FoilStudio::use_picture(const Field& field, const std::filesystem::path& file) {
    messages_.attempt([&] {
        recipe_.finish_edit();
        recipe_.set(field, std::filesystem::absolute(file).lexically_normal().string());
        recipe_.finish_edit();
    });
}

void FoilStudio::save(const std::filesystem::path& path) {
    if (messages_.attempt([&] { recipe_.save(path); })) messages_.say(path.string() + ": saved");
}

void FoilStudio::save_card(const std::filesystem::path& path) {
    if (path.extension() != ".glb") return messages_.say(path.string() + ": a card is a .glb file", true);
    save_to_ = path;
}

/// Writes the card where one was asked for, once it is there or cannot be made.
void FoilStudio::write_card() {
    if (save_to_.empty()) return;
    const std::string refused = refusal();
    const bool done = card_.current() && !card_.busy() && (*card_.value())->full;
    if (refused.empty() && !done) return;
    const std::filesystem::path path = std::exchange(save_to_, {});
    if (!refused.empty()) return messages_.say(refused, true);
    if (messages_.attempt([&] { write_file_atomic(path, (*card_.value())->glb); }))
        messages_.say(path.string() + ": the card");
}

void FoilStudio::begin_film(const post::OcioConfig& config, const FilmSettings& settings, PreviewInputs inputs) {
    messages_.attempt([&] { film_ = std::make_unique<TiltFilm>(config, settings, std::move(inputs)); });
}

void FoilStudio::film_step() {
    if (!film_) return;
    if (!messages_.attempt([&] { film_->step(); })) return film_.reset();
    if (!film_->finished()) return;
    messages_.say(film_->settings().path.string() + ": the film");
    film_.reset();
}

void FoilStudio::cancel_film() {
    if (film_) messages_.say(film_->settings().path.string() + ": no film was written");
    film_.reset();
}

}  // namespace rowland::inspector
