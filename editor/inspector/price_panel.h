#pragma once

#include "editor/inspector/control_map.h"
#include "editor/inspector/session.h"

namespace rowland::inspector {

/// The cost and the error of the material, and of the other representations it could have: a plot of error over price,
/// with a slider along the unbeaten choices.
class PricePanel {
 public:
    /// `frame_ms`: the median frame time here; 0: unknown.
    void draw(Session& session, double frame_ms, ControlMap& controls);

 private:
    float budget_ = 0.05F;
};

}  // namespace rowland::inspector
