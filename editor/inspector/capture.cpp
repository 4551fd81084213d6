#include "editor/inspector/capture.h"

#include <chrono>
#include <thread>

#include "editor/inspector/start_session.h"
#include "editor/inspector/window_frame.h"
#include "engine/app/context.h"
#include "engine/core/error.h"
#include "engine/view/capture.h"

namespace rowland::inspector {

namespace {

constexpr double kFrame_s = 1.0 / 30.0;

/// Waits for background work.
void settle(Session& session) {
    do {
        session.update();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    } while (session.busy());
    session.update();
}

void require_picture(const Session& session) {
    if (session.ready()) return;
    refuse_input({}, {}, session.messages().empty() ? "no light" : session.messages().back().text, {},
                 "nothing was written");
}

void capture_preview(Session& session, const Options& options, glm::ivec2 size) {
    // Maps are filled in the second frame in which nothing moves.
    for (int frame = 0; frame < 2; ++frame) session.draw(size, opening_camera(), false, static_cast<float>(kFrame_s));
    view::write_display_capture(session.preview().display(), *options.capture);
}

void capture_window(Session& session, const Options& options, const post::OcioConfig& config, Layout layout) {
    WindowFrame window_frame(options, config, session, layout);
    const glm::ivec2 size(layout.width, layout.height);
    const platform::InputState no_input;
    const auto draw_frame = [&]() -> const gpu::Framebuffer& {
        session.update();
        return window_frame.draw(no_input, false, {.size = size, .framebuffer_size = size, .seconds = kFrame_s}, 0.0);
    };
    draw_frame();
    if (options.measure) session.price();
    // The panes' numbers at a point are computed once there is a picture.
    do {
        draw_frame();
        settle(session);
    } while (session.busy());
    for (int frame = 0; frame < 2; ++frame) draw_frame();
    view::write_display_capture(draw_frame(), *options.capture);
}

}  // namespace

void capture(const Options& options, const post::OcioConfig& config) {
    app::render_offscreen(options.gl_debug, [&](const std::string&) {
        const Layout layout = chosen_layout(options);
        Session session(
            config, {.content_folder = options.content_folder, .probe_mapping = options.probe_mapping, .still = true});
        start_session(session, options, layout);
        settle(session);
        require_picture(session);
        if (options.preview_only)
            capture_preview(session, options, {layout.width, layout.height});
        else
            capture_window(session, options, config, layout);
    });
}

}  // namespace rowland::inspector
