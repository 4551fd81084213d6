// The part of the session that is about scenes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "editor/inspector/groove_picture.h"
#include "editor/inspector/session.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "modules/diffraction/asset/gltf_object.h"

namespace rowland::inspector {

namespace {

constexpr std::uint64_t kLargestPicture = 64 << 20;

}  // namespace

void Session::want_opening() {
    opening_.want(opening_of_ ? std::optional(opening_of_) : std::nullopt,
                  [path = opening_of_](const std::stop_token& stop, auto&&) {
                      auto opened = std::make_shared<OpenedScene>(open_scene(*path));
                      return stop.stop_requested() ? std::nullopt : std::optional(std::move(opened));
                  });
}

void Session::take_opened(const Opening::Change& change) {
    news_ = news_ || change.value || !change.failure.empty();
    if (!change.failure.empty()) {
        messages_.say(change.failure, true);
        opening_of_.reset();
    }
    if (!change.value || !opening_of_) return;
    opening_of_.reset();
    messages_.attempt([&] { adopt(std::move(**opening_.value())); });
    opening_.reset();
}

void Session::finish_opening() {
    want_opening();
    take_opened(opening_.wait());
}

void Session::cancel_opening() {
    if (!opening_of_) return;
    messages_.say(opening_of_->filename().string() + ": not opened");
    opening_of_.reset();
    opening_.reset();
}

bool Session::replaces_document(const std::filesystem::path& path) const {
    return is_scene_file(path) || (!document_.is_scene() && replaces_material(path));
}

void Session::adopt(OpenedScene opened) {
    SceneUpload uploaded = upload(*opened.object);
    adopt(std::move(opened.document));
    scene_ = opened.object;
    scene_on_gpu_ =
        std::make_shared<const PreviewObject>(PreviewObject{PreviewShape::Model, std::move(uploaded), scene_});
    cook_ = std::make_shared<GratingCook>(scene_);
    choose_shape(PreviewShape::Model);
    const std::string file = document_.name();
    for (const std::string& warning : scene_->imported.warnings) messages_.say(file + ": " + warning);
    std::size_t gratings = 0;
    for (std::size_t i = 0; i < document_.material_count(); ++i) gratings += document_.accepted(i) ? 1 : 0;
    messages_.say(fmt::format("{}: opened: {} materials, {} with a grating", file, scene_->materials.size(), gratings));
}

void Session::drop_scene() {
    gratings_.reset();
    scene_ = nullptr;
    scene_on_gpu_ = nullptr;
    surface_.reset();
    scene_frame_ = nullptr;
    picked_.reset();
    cook_ = std::make_shared<GratingCook>(nullptr);
    if (object_->scene) choose_shape(PreviewShape::Disc);
}

void Session::close_scene() {
    if (document_.is_scene()) messages_.attempt([&] { adopt(Document::open_as_new(preset_path("cd"))); });
}

void Session::use_material(Document document, const std::filesystem::path& path) {
    if (!document_.is_scene()) return adopt(std::move(document));
    document_.set_grating(
        diffraction::gltf_object(document.json(), std::filesystem::absolute(path).parent_path(), document_.folder()),
        document.name());
    messages_.say(document.name() + ": the grating of " + chosen_name());
}

std::string Session::chosen_name() const {
    const bool known = scene_ && document_.chosen() < scene_->materials.size();
    return known ? scene_->materials[document_.chosen()].name : document_.name();
}

void Session::choose_material(std::size_t material) {
    document_.choose(material);
    picked_.reset();
    surface_.reset();
    searched_for_.reset();
}

void Session::paste_grating(const std::string& text) {
    messages_.attempt([&] {
        document_.set_grating(parse_ordered(text, "the clipboard"), "the clipboard");
        messages_.say("the grating of " + chosen_name() + " is the clipboard's");
    });
}

void Session::remove_grating() {
    messages_.attempt([&] {
        document_.set_grating(nullptr, document_.name());
        messages_.say(chosen_name() + ": without a grating");
    });
}

void Session::set_groove_picture(std::vector<std::byte> picture, const std::string& name) {
    if (!document_.is_scene() || !document_.has_grating())
        refuse_input(
            name, {}, "a picture", "a scene with a grating on the chosen material",
            "open a .gltf or .glb, choose a material and attach a grating; the picture then varies its grooves");
    const std::size_t index = document_.new_textures().add(std::move(picture), name);
    Json texture = document_.json().value("grooveTexture", Json::object());
    texture["index"] = index;
    document_.finish_edit();
    document_.set_value(field_at("/grooveTexture"), texture);
    document_.finish_edit();
    messages_.say(name + ": the grooves of " + chosen_name());
}

void Session::set_groove_picture(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    set_groove_picture(as_groove_picture(read_file(path, kLargestPicture), name),
                       std::filesystem::path(name).replace_extension(".png").string());
}

void Session::set_foil_pattern(const std::string& name) {
    messages_.attempt([&] { set_groove_picture(foil_pattern(name), name + ".png"); });
}

void Session::pick(const glm::vec2& at) {
    const auto surface = preview_.pick(at);
    if (!surface) return;
    if (object_->scene && surface->material) document_.choose(*surface->material);
    surface_ = surface;
    picked_ = PickedPixel{.at = at, .surface = std::make_shared<const diffraction::ShadingPoint>(surface->frame)};
}

Gratings Session::shown_with(const CookedOf& chosen) const {
    const SceneGratings::Grating grating =
        document_.has_grating() && chosen.value() != nullptr ? *chosen.value() : nullptr;
    if (!object_->scene) return {grating};
    Gratings all = gratings_.all();
    if (&chosen == &saved_) all.at(document_.chosen()) = grating;
    return all;
}

std::optional<PickedSurface> Session::find_surface() {
    std::vector<glm::vec2> points;
    if (object_->scene) points = preview_.middles_of(document_.chosen());
    points.insert(points.end(), {glm::vec2(0.66F, 0.5F), glm::vec2(0.5F, 0.5F), glm::vec2(0.5F, 0.68F)});
    for (const glm::vec2 at : points)
        if (auto surface = preview_.pick(at); surface && (!object_->scene || surface->material == document_.chosen()))
            return surface;
    return std::nullopt;
}

diffraction::ShadingPoint Session::middle_frame() {
    const auto surface = find_surface();
    return surface ? surface->frame : diffraction::ShadingPoint{};
}

void Session::update_surface() {
    if (!object_->scene || !document_.has_grating() || !preview_.drawn()) {
        scene_frame_ = nullptr;
        return;
    }
    if (surface_ && surface_->material != document_.chosen()) {
        surface_.reset();
        picked_.reset();
    }
    if (!surface_ && searched_for_ != document_.chosen()) surface_ = find_surface();
    searched_for_ = document_.chosen();
    if (!surface_) return;
    const std::shared_ptr<const CookedGrating>& grating = gratings_.all().at(document_.chosen());
    if (!grating) return;
    const diffraction::ShadingPoint frame = turned(surface_->point, grating->groove_rotation + surface_->map_rotation);
    if (scene_frame_ && frame == *scene_frame_) return;
    surface_->frame = frame;
    scene_frame_ = std::make_shared<const diffraction::ShadingPoint>(frame);
    if (picked_) picked_->surface = scene_frame_;
}

}  // namespace rowland::inspector
