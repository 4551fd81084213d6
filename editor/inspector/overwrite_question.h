#pragma once

#include "editor/inspector/control_map.h"
#include "editor/inspector/session.h"

namespace rowland::inspector {

/// Asks whether to save over a scene file that another program changed, if the session wants to know. A modal window.
void draw_overwrite_question(Session& session, ControlMap& controls);

}  // namespace rowland::inspector
