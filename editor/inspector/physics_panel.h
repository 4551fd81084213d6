#pragma once

#include "editor/inspector/control_map.h"
#include "editor/inspector/pattern_pane.h"
#include "editor/inspector/session.h"
#include "engine/post/display_transform.h"

namespace rowland::inspector {

/// The light of the panes that show one wavelength or one direction.
struct PaneLight {
    double wavelength_nm = 550.0;
    double incidence_deg = 20.0;
    double azimuth_deg = 0.0;  ///< from across the grooves
};

/// The physics of the material as plots and numbers.
class PhysicsPanel {
 public:
    explicit PhysicsPanel(const post::OcioConfig& config) : display_(config) {}

    /// Into the current ImGui window.
    void draw(const Session& session, ControlMap& controls);

 private:
    void draw_point(const Session& session, const PointNumbers& numbers, ControlMap& controls) const;

    post::DisplayTransform display_;
    PaneLight light_;
    PatternPane pattern_;
};

}  // namespace rowland::inspector
