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
constexpr double kTurn_s = 7.0;  ///< of a hand's tilt

struct Stopped {};

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

void FoilStudio::advance(float seconds) {
    if (!moves()) return;
    // A slow frame does not let the card jump.
    phase_ += std::min(static_cast<double>(seconds), 0.25) / kTurn_s;
    phase_ -= std::floor(phase_);
}

void FoilStudio::want_card() {
    std::string key = recipe_.key(recipe_.json());
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
    return wall_.update(recipe_, !card_.busy()) || news;
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
        recipe_.set(field, std::filesystem::absolute(file).lexically_normal().generic_string());
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
