#include "editor/inspector/session.h"

#include <utility>

#include "engine/app/drawing_program.h"
#include "engine/view/picture.h"
namespace rowland::inspector {

namespace {

/// The shape on which a preset shows its colours without a change of view. The sheet is bent, so that light and eye are
/// nearly along the surface somewhere: only there the finest grooves send light, and the coarsest reflect a streak.
PreviewShape shape_of_preset(const std::string& name) {
    return name.starts_with("cd") || name == "dvd" ? PreviewShape::Disc : PreviewShape::Sheet;
}

}  // namespace

Session::Session(const post::OcioConfig& config, const SessionSettings& settings)
    : light({settings.content_folder / "probes", settings.captures}, settings.probe_mapping, messages),
      opened(settings.content_folder / "materials", messages),
      view(config, settings.still, opened, light, messages),
      measurement(opened, light, view, messages) {}

void Session::open(const std::filesystem::path& path) {
    bool is_light = false;
    if (!messages.attempt([&] { is_light = is_light_file(path); })) return;
    is_light ? light.choose(path) : opened.open(path);
}

void Session::open_preset(const std::string& name) {
    if (!opened.open_preset(name) || opened.document().is_scene()) return;
    const bool lattice = opened.document().material().grating.lattice.has_value();
    view.choose_shape(lattice ? PreviewShape::Card : shape_of_preset(name));
}

bool Session::update() {
    bool news = opened.update();
    view.update();
    news = light.update() || news;
    news = measurement.update() || news;
    const bool before = std::exchange(was_busy_, busy());
    return news || was_busy_ != before;
}

}  // namespace rowland::inspector
