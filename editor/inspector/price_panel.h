#pragma once

#include "editor/inspector/control_map.h"
#include "editor/inspector/session.h"

namespace rowland::inspector {

/// What the material costs and loses, and what it could cost: error against the reference over price, with a slider
/// along the choices that nothing beats.
class PricePanel {
 public:
    /// `frame_ms`: the median frame here; 0: nobody knows.
    void draw(Session& session, double frame_ms, ControlMap& controls);

 private:
    float budget_ = 0.05F;
};

}  // namespace rowland::inspector
