#pragma once

#include <memory>

#include "editor/inspector/control_map.h"
#include "editor/inspector/session.h"
#include "engine/gpu/texture.h"
#include "engine/post/display_transform.h"

namespace rowland::inspector {

/// The diffraction pattern of a lattice, through the view's exposure and display.
class PatternPane {
 public:
    /// Into the current ImGui window.
    void draw(const Session& session, const post::DisplayTransform& display, ControlMap& controls);

 private:
    void paint(const Session& session, const post::DisplayTransform& display);

    std::shared_ptr<const PatternFigure> shown_;  ///< in texture_, with exposure_stops_
    float exposure_stops_ = 0.0F;
    gpu::Texture texture_;
};

}  // namespace rowland::inspector
