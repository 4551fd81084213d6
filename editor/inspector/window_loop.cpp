#include "editor/inspector/window_loop.h"

#include <algorithm>
#include <variant>

#include "editor/inspector/redraw.h"
#include "editor/inspector/start_session.h"
#include "editor/inspector/window_frame.h"
#include "engine/app/window_loop.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gpu/lost_context.h"

namespace rowland::inspector {

namespace {

/// Each poll of the window adds the state of the game pad, which the inspector does not use.
bool is_of_user(const platform::InputEvent& event) {
    return !std::holds_alternative<platform::GamepadEvent>(event);
}

class Program {
 public:
    Program(const Options& options, const post::OcioConfig& config)
        : layout_file_(options.layout ? options.layout : default_layout_file()),
          layout_(chosen_layout(options)),
          loop_("Rowland: material inspector", {layout_.width, layout_.height}, options.gl_debug),
          session_(config, {.content_folder = options.content_folder, .probe_mapping = options.probe_mapping}),
          window_frame_(options, config, session_, layout_) {
        start_session(session_, options, layout_);
    }

    void run() {
        try {
            loop_.run([this](const app::Frame& frame) { return update(frame); },
                      [this](const app::Frame& frame) { draw(frame); });
        } catch (...) {
            rescue();
            throw;
        }
        store_layout();
        report("frames", loop_.times());
        report("frames of drags", drag_times_);
    }

 private:
    app::Next update(const app::Frame& frame) {
        gpu::require_context();
        if (dragged_) drag_times_.add(frame.elapsed);
        input_.begin_frame();
        for (const platform::InputEvent& event : frame.events) input_.apply(event);
        dragged_ = input_.mouse_button(platform::MouseButton::Left).down;
        for (const std::filesystem::path& file : frame.dropped) window_frame_.workbench().open(file);
        if (loop_.window().should_close()) {
            loop_.window().request_close(false);
            window_frame_.workbench().ask_to_close();
        }
        if (window_frame_.workbench().closed()) return app::Next::End;
        const bool results = session_.update();
        const bool used = frame.woken || !frame.dropped.empty() || input_.any_down() || frame.pixels != drawn_pixels_ ||
                          std::ranges::any_of(frame.events, is_of_user);
        return redraw_.next(used || results || session_.picture_changes() || window_frame_.workbench().due(),
                            session_.busy(), Redraw::Clock::now());
    }

    void draw(const app::Frame& frame) {
        drawn_pixels_ = frame.pixels;
        window_frame_
            .draw(input_, true, {.size = frame.size, .framebuffer_size = frame.pixels, .seconds = frame.seconds()},
                  loop_.times().statistics().median_ms)
            .show_in_window();
    }

    void rescue() const {
        try {
            if (const auto file = session_.document().rescue())
                log_warning("{}: holds the edits that were not saved", file->string());
        } catch (const std::exception& error) {
            log_warning("edits are lost: {}", error.what());
        }
    }

    static void report(const char* what, const platform::FrameTimes& times) {
        const platform::FrameStatistics statistics = times.statistics();
        log_info("the last {} {}: median {:.1f} ms, longest {:.1f} ms", statistics.count, what, statistics.median_ms,
                 statistics.maximum_ms);
    }

    void store_layout() {
        if (!layout_file_) return;
        layout_.width = loop_.window().size().x;
        layout_.height = loop_.window().size().y;
        layout_.stage = session_.stage;
        layout_.shape = preview_shape_name(session_.shape());
        if (session_.light()) layout_.light = std::filesystem::absolute(session_.light()->path).string();
        try {
            save_layout(layout_, *layout_file_);
        } catch (const Error& error) {
            log_warning("{}", error.what());
        }
    }

    std::optional<std::filesystem::path> layout_file_;
    Layout layout_;
    app::WindowLoop loop_;
    Session session_;
    WindowFrame window_frame_;
    platform::InputState input_;
    platform::FrameTimes drag_times_;  ///< with the mouse button down
    bool dragged_ = false;             ///< in the last frame
    glm::ivec2 drawn_pixels_{0};       ///< of the last frame
    Redraw redraw_;
};

}  // namespace

void run_in_window(const Options& options, const post::OcioConfig& config) {
    Program(options, config).run();
}

}  // namespace rowland::inspector
