#pragma once

#include "editor/inspector/control_map.h"
#include "editor/inspector/physics/angle_curve.h"
#include "editor/inspector/session.h"
#include "engine/post/display_transform.h"

namespace rowland::inspector {

/// The physics of the material as plots and numbers.
class PhysicsPanel {
 public:
    explicit PhysicsPanel(const post::OcioConfig& config) : display_(config) {}

    /// Into the present ImGui window.
    void draw(Session& session, ControlMap& controls);

 private:
    void draw_choices(ControlMap& controls);
    void draw_angles(const diffraction::Grating& grating) const;
    void draw_efficiencies(const Session& session) const;
    void draw_kernel(const diffraction::CookedMaterial& cooked) const;
    void draw_directions(const diffraction::Grating& grating) const;
    void draw_point(const Session& session, ControlMap& controls) const;
    void draw_sweep(const Session& session) const;
    void draw_energy(const diffraction::Grating& grating, ControlMap& controls) const;

    post::DisplayTransform display_;
    float wavelength_nm_ = 550.0F;
    float incidence_deg_ = 20.0F;
    float azimuth_deg_ = 0.0F;  ///< of the light, from across the grooves
};

}  // namespace rowland::inspector
