#pragma once

#include <imgui.h>

#include <glm/vec2.hpp>

#include "editor/inspector/control_map.h"
#include "editor/inspector/session.h"

namespace rowland::inspector {

/// A handle on the surface of a scene that points along the grooves; dragging it turns them. Points are screen
/// coordinates, `corner` and `size` those of the picture.
class GrooveHandle {
 public:
    /// Whether there is one, and its knob is at the point.
    static bool grabs(const Session& session, const ImVec2& corner, const ImVec2& size, const ImVec2& at);
    /// Turns the grooves so that the knob points to `at`, a point as Preview::pick() takes it.
    static void drag(Session& session, const glm::vec2& at);
    static void draw(const Session& session, const ImVec2& corner, const ImVec2& size, ControlMap& controls);
};

}  // namespace rowland::inspector
