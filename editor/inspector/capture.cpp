#include "editor/inspector/capture.h"

#include <chrono>
#include <thread>

#include "editor/inspector/session.h"
#include "editor/inspector/start_session.h"
#include "editor/inspector/workbench.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gpu/debug.h"
#include "engine/gpu/framebuffer.h"
#include "engine/platform/headless_context.h"
#include "engine/ui/ui.h"
#include "engine/view/capture.h"

namespace rowland::inspector {

namespace {

constexpr float kFrame_s = 1.0F / 30.0F;

/// Waits for the work beside the frames.
void settle(Session& session) {
    do {
        session.update();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    } while (session.busy());
    session.update();
}

void require_picture(const Session& session) {
    if (session.ready()) return;
    throw Error({.file = {},
                 .place = {},
                 .found = session.messages().empty() ? "no light" : session.messages().back().text,
                 .expected = {},
                 .remedy = "nothing was written"});
}

void capture_preview(Session& session, const Options& options, glm::ivec2 size) {
    // Maps are filled for what has come to rest.
    for (int frame = 0; frame < 2; ++frame) session.draw(size, opening_camera(), false, kFrame_s);
    view::write_display_capture(session.preview().display(), *options.capture);
}

void capture_window(Session& session, const Options& options, const post::OcioConfig& config, Layout layout) {
    ui::Ui ui({.scale = layout.scale});
    const glm::ivec2 size(layout.width, layout.height);
    const gpu::Framebuffer target({.width = size.x, .height = size.y, .colours = {gpu::Format::RGBA8}});
    ControlMap controls(options.controls);
    Workbench workbench(config, session, layout, controls);
    const platform::InputState nobody;
    const auto draw_frame = [&] {
        session.update();
        ui.begin_frame(nobody, {.size = size, .framebuffer_size = size, .seconds = static_cast<double>(kFrame_s)});
        workbench.draw(nobody, false,
                       {.size = glm::vec2(size), .pixels_per_unit = 1.0F, .seconds = kFrame_s, .frame_ms = 0.0});
        target.clear({0.05F, 0.05F, 0.05F, 1.0F});
        ui.draw(target);
    };
    draw_frame();
    if (options.measure) session.price();
    // What the panes show of a point is computed once there is a picture.
    do {
        draw_frame();
        settle(session);
    } while (session.busy());
    for (int frame = 0; frame < 3; ++frame) draw_frame();
    view::write_display_capture(target, *options.capture);
}

}  // namespace

void capture(const Options& options, const post::OcioConfig& config) {
    const platform::HeadlessContext context;
    gpu::enable_debug_output(false);
    const Layout layout = chosen_layout(options);
    Session session(config,
                    {.content_folder = options.content_folder, .probe_mapping = options.probe_mapping, .still = true});
    start_session(session, options, layout);
    settle(session);
    require_picture(session);
    if (options.preview_only)
        capture_preview(session, options, {layout.width, layout.height});
    else
        capture_window(session, options, config, layout);
    log_info("wrote {}", options.capture->string());
}

}  // namespace rowland::inspector
