#include "editor/inspector/window_loop.h"

#include "editor/inspector/start_session.h"
#include "editor/inspector/window_frame.h"
#include "engine/app/window_loop.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gpu/lost_context.h"

namespace rowland::inspector {

namespace {

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
        if (dragged_) drag_times_.add(frame.elapsed);
        input_.begin_frame();
        for (const platform::InputEvent& event : frame.events) input_.apply(event);
        dragged_ = input_.mouse_button(platform::MouseButton::Left).down;
        for (const std::filesystem::path& file : frame.dropped) session_.open(file);
        if (loop_.window().should_close()) {
            loop_.window().request_close(false);
            window_frame_.workbench().ask_to_close();
        }
        if (window_frame_.workbench().closed()) return app::Next::End;
        session_.update();
        constexpr int kAwakeFrames = 15;
        const bool used = input_.mouse_delta() != glm::dvec2(0.0) || input_.scroll() != glm::dvec2(0.0) || dragged_ ||
                          !input_.typed().empty() || session_.cooking();
        quiet_frames_ = used ? 0 : quiet_frames_ + 1;
        return quiet_frames_ > kAwakeFrames ? app::Next::Rest : app::Next::Frame;
    }

    void draw(const app::Frame& frame) {
        gpu::require_context();
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
    int quiet_frames_ = 0;
};

}  // namespace

void run_in_window(const Options& options, const post::OcioConfig& config) {
    Program(options, config).run();
}

}  // namespace rowland::inspector
