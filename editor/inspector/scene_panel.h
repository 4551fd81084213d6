#pragma once

#include "editor/inspector/control_map.h"
#include "editor/inspector/session.h"

namespace rowland::inspector {

/// The materials of an open scene: which one is edited, its meshes, and its grating as a whole.
class ScenePanel {
 public:
    /// Into the current ImGui window; nothing if neither a scene is open nor one is being opened.
    void draw(Session& session, ControlMap& controls);

 private:
    void draw_list(Session& session, ControlMap& controls);

    std::size_t listed_ = 0;  ///< the chosen material in the last frame
};

}  // namespace rowland::inspector
