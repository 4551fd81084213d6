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

/// Side, in pixels of the picture, of the square for which the reference is computed once.
inline constexpr int kReferenceTexelSide = 4;

struct ReferenceInputs;

/// A reference picture, possibly incomplete.
struct ReferenceTexels {
    std::vector<glm::vec4> xyz;  ///< row by row from the bottom; alpha 0: no grating
    std::size_t done = 0;        ///< finished texels, of `all`
    std::size_t all = 1;
};

/// The reference's picture of all gratings without a groove texture, computed in the background. Passes halve the step
/// from 8 texels to 1, right of the wipe's line first. Any motion cancels it; it starts again when nothing moves.
class ReferencePicture {
 public:
    /// To be called once per frame, after world matrices were updated. `pixels`: the picture's size. Passes the texels
    /// so far to `comparison`, or removes them if the view has changed.
    void update(ecs::World& world, Comparison& comparison, const scene::Camera& camera, glm::ivec2 pixels,
                const PixelProbe& probe);
    /// Cancels the computation and removes the picture.
    void stop(Comparison& comparison);

    /// Whether a computation for the current view runs or has ended.
    bool begun() const { return view_ != nullptr && texels_.wants(view_); }
    /// Fraction of the texels that are computed.
    double progress() const;
    /// Why the computation failed; empty if it did not.
    const std::string& failure() const { return failure_; }

 private:
    std::shared_ptr<const ReferenceInputs> view_;  ///< of the current view
    int frames_at_rest_ = 0;
    std::shared_ptr<gpu::Texture> texture_;  ///< shown by the comparison
    std::string failure_;
    Computed<std::shared_ptr<const ReferenceInputs>, ReferenceTexels> texels_;
};

}  // namespace rowland::demo
