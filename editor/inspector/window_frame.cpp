#include "editor/inspector/window_frame.h"

namespace rowland::inspector {

WindowFrame::WindowFrame(const Options& options, const post::OcioConfig& config, Session& session, Layout& layout)
    : layout_(layout),
      session_(session),
      ui_({.scale = layout.scale}),
      controls_(options.controls),
      workbench_(config, session, layout, controls_) {}

const gpu::Framebuffer& WindowFrame::draw(const platform::InputState& input, bool keys, const ui::UiFrame& frame,
                                          double frame_ms) {
    if (layout_.scale != ui_.scale()) ui_.set_scale(layout_.scale);
    ui_.begin_frame(input, frame);
    workbench_.draw(input, keys && !ui_.wants_text(),
                    {.size = glm::vec2(frame.size),
                     .pixels_per_unit = static_cast<float>(frame.framebuffer_size.x) / static_cast<float>(frame.size.x),
                     .seconds = static_cast<float>(frame.seconds),
                     .frame_ms = frame_ms,
                     .in_window = keys});
    const glm::ivec2 pixels = frame.framebuffer_size;
    if (!target_ || target_->size() != pixels)
        target_.emplace(gpu::FramebufferDesc{.width = pixels.x, .height = pixels.y, .colours = {gpu::Format::RGBA8}});
    target_->clear({0.05F, 0.05F, 0.05F, 1.0F});
    ui_.draw(*target_);
    if (workbench_.take_screenshot()) session_.write_screenshot(*target_);
    return *target_;
}

}  // namespace rowland::inspector
