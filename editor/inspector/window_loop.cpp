#include "editor/inspector/window_loop.h"

#include <chrono>
#include <thread>

#include "editor/inspector/session.h"
#include "editor/inspector/start_session.h"
#include "editor/inspector/workbench.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gpu/debug.h"
#include "engine/gpu/framebuffer.h"
#include "engine/gpu/lost_context.h"
#include "engine/platform/frame_pacing.h"
#include "engine/platform/window.h"
#include "engine/ui/ui.h"

namespace rowland::inspector {

namespace {

class WindowLoop {
 public:
    WindowLoop(const Options& options, const post::OcioConfig& config)
        : layout_file_(options.layout ? options.layout : usual_layout_file()),
          layout_(chosen_layout(options)),
          window_({.title = "Rowland: material inspector", .size = {layout_.width, layout_.height}}),
          ui_({.scale = layout_.scale}),
          session_(config, {.content_folder = options.content_folder, .probe_mapping = options.probe_mapping}),
          controls_(options.controls),
          workbench_(config, session_, layout_, controls_) {
        gpu::enable_debug_output(false);
        start_session(session_, options, layout_);
        window_.set_drop_handler([this](const std::vector<std::filesystem::path>& files) {
            for (const std::filesystem::path& file : files) session_.open(file);
        });
    }

    void run() {
        try {
            draw_until_closed();
        } catch (...) {
            rescue();
            throw;
        }
        remember();
        tell("frames", times_);
        tell("frames of drags", drag_times_);
    }

 private:
    void draw_until_closed() {
        while (!workbench_.closed()) {
            const std::chrono::nanoseconds elapsed = clock_.tick();
            times_.add(elapsed);
            if (dragged_) drag_times_.add(elapsed);
            window_.poll(input_);
            dragged_ = input_.mouse_button(platform::MouseButton::Left).down;
            if (window_.should_close()) {
                window_.request_close(false);
                workbench_.ask_to_close();
            }
            session_.update();
            const glm::ivec2 pixels = window_.framebuffer_size();
            if (pixels.x < 1 || pixels.y < 1) {  // minimised: nothing to draw, and no display to wait for
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
                continue;
            }
            draw(pixels, std::chrono::duration<double>(elapsed).count());
            window_.swap();
            rest_if_idle();
        }
    }

    void rescue() const {
        try {
            if (const auto file = session_.document().rescue())
                log_warning("{}: edits not saved before", file->string());
        } catch (const std::exception& error) {
            log_warning("edits are lost: {}", error.what());
        }
    }

    static void tell(const char* what, const platform::FrameTimes& times) {
        const platform::FrameStatistics statistics = times.statistics();
        log_info("the last {} {}: median {:.1f} ms, longest {:.1f} ms", statistics.count, what, statistics.median_ms,
                 statistics.maximum_ms);
    }

    void draw(glm::ivec2 pixels, double seconds) {
        gpu::require_context();
        const glm::ivec2 size = window_.size();
        if (layout_.scale != ui_.scale()) ui_.set_scale(layout_.scale);
        ui_.begin_frame(input_, {.size = size, .framebuffer_size = pixels, .seconds = seconds});
        workbench_.draw(input_, !ui_.wants_text(),
                        {.size = glm::vec2(size),
                         .pixels_per_unit = static_cast<float>(pixels.x) / static_cast<float>(size.x),
                         .seconds = static_cast<float>(seconds),
                         .frame_ms = times_.statistics().median_ms});
        if (!target_ || target_->size() != pixels)
            target_.emplace(
                gpu::FramebufferDesc{.width = pixels.x, .height = pixels.y, .colours = {gpu::Format::RGBA8}});
        target_->clear({0.05F, 0.05F, 0.05F, 1.0F});
        ui_.draw(*target_);
        target_->show_in_window();
    }

    /// Leaves the processor to the work beside the frames while the user does nothing.
    void rest_if_idle() {
        constexpr int kAwakeFrames = 15;
        const bool used = input_.mouse_delta() != glm::dvec2(0.0) || input_.scroll() != glm::dvec2(0.0) || dragged_ ||
                          !input_.typed().empty() || session_.cooking();
        quiet_frames_ = used ? 0 : quiet_frames_ + 1;
        if (quiet_frames_ > kAwakeFrames) std::this_thread::sleep_for(std::chrono::milliseconds(30));
    }

    void remember() {
        if (!layout_file_) return;
        layout_.width = window_.size().x;
        layout_.height = window_.size().y;
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
    platform::Window window_;
    ui::Ui ui_;
    Session session_;
    ControlMap controls_;
    Workbench workbench_;
    std::optional<gpu::Framebuffer> target_;
    platform::InputState input_;
    platform::FrameClock clock_;
    platform::FrameTimes times_;
    platform::FrameTimes drag_times_;  ///< with the mouse button down
    bool dragged_ = false;             ///< in the last frame
    int quiet_frames_ = 0;
};

}  // namespace

void run_in_window(const Options& options, const post::OcioConfig& config) {
    WindowLoop(options, config).run();
}

}  // namespace rowland::inspector
