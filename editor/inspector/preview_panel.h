#pragma once

#include <imgui.h>

#include "editor/inspector/control_map.h"
#include "editor/inspector/session.h"
#include "engine/platform/input.h"
#include "engine/scene/orbit_camera.h"

namespace rowland::inspector {

/// The preview with its tools: drag orbits, the wheel zooms, a click picks a point, and a line divides the saved
/// version from the present one.
class PreviewPanel {
 public:
    PreviewPanel();

    /// Into the current ImGui window. `pixels_per_unit`: of the framebuffer, per screen coordinate; `seconds`: since
    /// the last frame.
    void draw(Session& session, const platform::InputState& input, float pixels_per_unit, float seconds,
              ControlMap& controls);

    bool comparing = false;  ///< the saved version is shown to the left of the line

 private:
    void draw_tools(Session& session, ControlMap& controls);
    void draw_picture(const Session& session, const ImVec2& corner, const ImVec2& size) const;
    void draw_saved(const Session& session, const ImVec2& corner, const ImVec2& end) const;
    void draw_lamp(const Stage& stage, const ImVec2& corner, const ImVec2& size, ControlMap& controls) const;
    bool near_lamp(const Stage& stage, const glm::vec2& at, const ImVec2& size) const;
    void use_mouse(Session& session, const platform::InputState& input, const ImVec2& corner, const ImVec2& size);

    enum class Drag { None, Line, Lamp, Grooves, Orbit };

    scene::OrbitCamera camera_;
    float line_ = 0.5F;  ///< its distance from the picture's left edge, as a fraction of the width
    Drag drag_ = Drag::None;
    bool lamp_behind_ = false;  ///< when the drag of the lamp began
};

}  // namespace rowland::inspector
