#include "editor/inspector/start_session.h"

#include "engine/core/error.h"

namespace rowland::inspector {

namespace {

/// A file of the command line must open.
void require_opened(const Session& session) {
    if (session.messages().empty() || !session.messages().back().failure) return;
    refuse_input({}, {}, session.messages().back().text, {});
}

}  // namespace

Layout chosen_layout(const Options& options) {
    Layout layout;
    if (const auto file = options.layout ? options.layout : default_layout_file()) layout = load_layout(*file);
    if (options.width > 0) layout.width = options.width;
    if (options.height > 0) layout.height = options.height;
    if (options.scale > 0.0F) layout.scale = options.scale;
    if (options.shape) layout.shape = preview_shape_name(*options.shape);
    return layout;
}

void start_session(Session& session, const Options& options, const Layout& layout) {
    session.stage = layout.stage;
    if (const auto shape = parse_preview_shape(layout.shape)) session.choose_shape(*shape);
    if (options.preset) {
        session.open_preset(*options.preset);
        if (options.shape) session.choose_shape(*options.shape);
        require_opened(session);
    }
    if (options.file) {
        session.open(*options.file);
        session.finish_opening();
        require_opened(session);
    }
    std::error_code ignored;
    if (options.probe)
        session.choose_light(*options.probe);
    else if (!layout.light.empty() && std::filesystem::exists(layout.light, ignored))
        session.choose_light(layout.light);
    else if (const auto lights = session.shipped_lights(); !lights.empty())
        session.choose_light(lights.back());
}

}  // namespace rowland::inspector
