#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "editor/inspector/control_map.h"
#include "editor/inspector/layout.h"
#include "editor/inspector/options.h"
#include "editor/inspector/session.h"
#include "editor/inspector/workbench.h"
#include "engine/gpu/framebuffer.h"
#include "engine/ui/ui.h"

namespace rowland::inspector {

/// The contents of the inspector's window, drawn into a framebuffer.
class WindowFrame {
 public:
    /// All but `options` must outlive it.
    WindowFrame(const Options& options, const post::OcioConfig& config, Session& session, Layout& layout);

    Workbench& workbench() { return workbench_; }
    /// `frame` as for ui::Ui; `keys`: whether shortcuts work; `frame_ms`: to show, 0: none.
    const gpu::Framebuffer& draw(const platform::InputState& input, bool keys, const ui::UiFrame& frame,
                                 double frame_ms);

 private:
    Layout& layout_;
    Session& session_;
    ui::Ui ui_;
    ControlMap controls_;
    Workbench workbench_;
    std::optional<gpu::Framebuffer> target_;
};

}  // namespace rowland::inspector
