#pragma once

#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "content/demo/looks/comparison.h"
#include "content/demo/pixel/pixel_meter.h"
#include "content/demo/pixel/surface_point.h"
#include "engine/core/computed.h"
#include "engine/gpu/texture.h"
#include "engine/scene/camera.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::demo {

/// Side of a still's texel, in pixels of the picture.
inline constexpr int kStillTexel = 4;

/// Everything that a still depends on.
struct StillView;

/// A still, or what is known of it so far.
struct StillTexels {
    std::vector<glm::vec4> xyz;  ///< row by row from the bottom; alpha 0: no grating
    std::size_t done = 0;        ///< texels that are computed
    std::size_t all = 1;
};

/// The reference's picture of all gratings, computed in the background from coarse to fine: first every eighth texel of
/// every eighth row, then every fourth, and so on; first right of the wipe's line. It restarts after any motion, once
/// nothing moves.
class ReferenceStill {
 public:
    /// To be called once per frame, after world matrices were updated. `pixels`: of the picture. Gives the comparison
    /// the still so far, or removes it if the view has changed.
    void update(ecs::World& world, Comparison& comparison, const scene::Camera& camera, glm::ivec2 pixels,
                const PixelProbe& probe);
    /// Cancels the computation and removes the still.
    void stop(Comparison& comparison);

    /// Whether it is being computed or done.
    bool begun() const { return view_ != nullptr && texels_.wants(view_); }
    /// Fraction of the texels that are computed.
    double progress() const;
    /// Why the computation failed; empty if it did not.
    const std::string& failure() const { return failure_; }

 private:
    std::shared_ptr<const StillView> view_;  ///< at present
    int frames_at_rest_ = 0;
    std::shared_ptr<gpu::Texture> texture_;  ///< that the comparison shows
    std::string failure_;
    Computed<std::shared_ptr<const StillView>, StillTexels> texels_;
};

}  // namespace rowland::demo
