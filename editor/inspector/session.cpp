#include "editor/inspector/session.h"

#include <fmt/format.h>

#include <chrono>
#include <future>
#include <utility>
#include <vector>

#include "engine/core/child_process.h"
#include "engine/core/error.h"
#include "engine/core/system.h"

namespace rowland::inspector {

namespace {

/// The shape on which a preset shows its colours without a change of view. The sheet is bent, so that light and view
/// are grazing somewhere on it: only there the finest grooves diffract visible light and the coarsest reflect a streak.
PreviewShape shape_of_preset(const std::string& name) {
    return name.starts_with("cd") || name == "dvd" ? PreviewShape::Disc : PreviewShape::Sheet;
}

/// Starts a program that lies beside this one, as start_program() does.
std::future<int> start_beside(const char* name, const std::vector<std::string>& arguments) {
    return start_program(program_file().parent_path() / name, arguments);
}

}  // namespace

Session::Session(const post::OcioConfig& config, const SessionSettings& settings)
    : light({settings.content_folder / "probes", settings.captures}, settings.probe_mapping, messages),
      opened(settings.content_folder / "materials", messages),
      view(config, settings.still, opened, light, messages),
      measurement(opened, light, view, messages),
      still_(settings.still) {}

void Session::open(const std::filesystem::path& path) {
    messages.attempt([&] {
        if (is_foil_recipe_file(path)) return start_foil(FoilRecipe::open(path));
        if (is_picture_file(path) && foil) return foil->use_picture(foil->dropped_field(), path);
        if (is_picture_file(path) && !opened.document().is_scene()) return make_foil(path);
        if (is_light_file(path)) return light.choose(path);
        close_foil();
        opened.open(path);
    });
}

bool Session::is_replaced_by(const std::filesystem::path& path) const {
    try {
        if (is_picture_file(path)) return !foil && !opened.document().is_scene();
        if (is_foil_recipe_file(path)) return true;
        return foil ? !is_light_file(path) : opened.is_replaced_by(path);
    } catch (const Error&) {
        return false;  // the file will be refused
    }
}

void Session::start_foil(FoilRecipe recipe) {
    messages.say(recipe.name() + ": a foil card");
    foil = std::make_unique<FoilStudio>(std::move(recipe), messages);
    foil->tilting = !still_;
}

void Session::make_foil(const std::filesystem::path& artwork) {
    messages.attempt([&] { start_foil(FoilRecipe::make_new(artwork)); });
}

void Session::close_foil() {
    foil.reset();
    view.card.reset();
}

void Session::open_preset(const std::string& name) {
    close_foil();
    if (!opened.open_preset(name) || opened.document().is_scene()) return;
    const Document& document = opened.document();
    const bool lattice = document.has_grating() && document.material().grating.lattice.has_value();
    view.choose_shape(document.has_film() ? PreviewShape::Sphere
                      : lattice           ? PreviewShape::Card
                                          : shape_of_preset(name));
}

void Session::open_in_demo() {
    messages.attempt([&] {
        std::vector<std::string> arguments = opened.demo_arguments();
        if (light.current())
            arguments.insert(arguments.end(), {"--probe", std::filesystem::absolute(light.current()->path).string()});
        start_beside("rowland-demo", arguments);
        messages.say("the demo starts");
    });
}

std::size_t Session::boxes() const {
    return opened.document().boxes().size();
}

void Session::capture_probes() {
    messages.attempt([&] {
        if (boxes() == 0 || capturing() || !light.current()) return;
        if (opened.document().dirty())
            refuse_input(opened.document().name(), "", "unsaved changes",
                         "a saved scene, as the capture draws the file", "save it");
        capture_ = start_beside("rowland-cook", {"capture", std::filesystem::absolute(opened.scene()->file).string(),
                                                 "--probe", std::filesystem::absolute(light.current()->path).string()});
        messages.say(fmt::format("capturing the light of {} {}", boxes(), boxes() == 1 ? "box" : "boxes"));
    });
}

bool Session::take_capture() {
    if (!capturing() || capture_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    const int code = capture_.get();
    if (code == 0)
        messages.say("the boxes' light is captured; the demo shows it");
    else
        messages.say(fmt::format("the capture failed with exit code {}; the terminal says why", code), true);
    return true;
}

bool Session::update() {
    bool news = take_capture();
    if (foil) {
        news = foil->update() || news;
        view.card = foil->card();
    } else {
        news = opened.update() || news;  // a document that is not shown is not cooked
    }
    view.update();
    news = light.update() || news;
    news = (!foil && measurement.update()) || news;
    const bool before = std::exchange(was_busy_, busy());
    return news || was_busy_ != before;
}

}  // namespace rowland::inspector
