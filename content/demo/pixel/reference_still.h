#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "content/demo/looks/comparison.h"
#include "content/demo/pixel/pixel_meter.h"
#include "content/demo/pixel/visible_points.h"
#include "engine/core/latest_task.h"
#include "engine/gpu/texture.h"
#include "engine/scene/camera.h"
#include "modules/diffraction/model/frame.h"

namespace rowland::demo {

/// Side of a still's texel, in pixels of the picture.
inline constexpr int kStillTexel = 4;

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
    bool begun() const { return job_ != nullptr; }
    /// Fraction of the texels that are computed.
    double progress() const;
    /// Why the computation failed; empty if it did not.
    const std::string& failure() const { return failure_; }

 private:
    struct View;
    struct Job;
    static View view_of(ecs::World& world, Comparison& comparison, const scene::Camera& camera, glm::ivec2 pixels,
                        const PixelProbe& probe);
    void begin(float line);
    void show(Comparison& comparison);

    std::shared_ptr<const View> view_;  ///< at present
    int frames_at_rest_ = 0;
    std::shared_ptr<Job> job_;
    std::shared_ptr<gpu::Texture> still_;  ///< that the comparison shows
    std::size_t shown_ = 0;                ///< texels of it that are computed
    std::string failure_;
    LatestTask<bool> task_;
};

}  // namespace rowland::demo
