#pragma once

#include <atomic>
#include <cstdint>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "content/demo/looks/background.h"
#include "content/demo/looks/comparison.h"
#include "content/demo/pixel/pixel_meter.h"
#include "content/demo/pixel/visible_points.h"
#include "engine/gpu/texture.h"
#include "engine/scene/camera.h"
#include "modules/diffraction/model/frame.h"

namespace rowland::demo {

/// Pixels of the picture along a side of a still's texel.
inline constexpr int kStillTexel = 4;

/// The reference's picture of all gratings as they stand, computed beside the frames, from coarse to fine: first every
/// eighth texel of every eighth row, then every fourth, and so on; all that at first lies right of the line of the wipe
/// before the rest. Begins anew when anything has moved, once it rests.
class ReferenceStill {
 public:
    ~ReferenceStill();

    /// Once a frame, with matrices up to date. `pixels`: of the picture. Hands the comparison the still so far, or
    /// takes it away if it is of another view.
    void update(ecs::World& world, Comparison& comparison, const scene::Camera& camera, glm::ivec2 pixels,
                const PixelProbe& probe);
    /// Nobody wants it any more.
    void stop(Comparison& comparison);

    /// Whether it is being computed, or is done: all rests.
    bool begun() const { return job_ != nullptr; }
    /// Share of the texels that are computed, 0 to 1.
    double progress() const;
    /// Why there is none; empty if there is.
    const std::string& failure() const { return failure_; }

 private:
    struct View;
    struct Job;
    static View view_of(ecs::World& world, Comparison& comparison, const scene::Camera& camera, glm::ivec2 pixels,
                        const PixelProbe& probe);
    struct Texel;
    using Points = std::vector<std::optional<VisiblePoint>>;
    struct Columns;
    static std::vector<Texel> texels_of_pass(const View& view, const Points& points, int step, std::size_t mesh,
                                             const Columns& columns);
    static bool compute_passes(Job& job, const lighting::ProbeImage& probe, const Points& points,
                               const Columns& columns);
    static bool compute_pass(Job& job, const lighting::ProbeImage& probe, const std::vector<Texel>& texels, int step,
                             const diffraction::Material& material);
    static void compute(Job& job);
    void begin(float line);
    void show(Comparison& comparison);

    std::shared_ptr<const View> view_;  ///< as it is now
    int frames_at_rest_ = 0;
    std::shared_ptr<Job> job_;
    std::future<void> running_;
    std::shared_ptr<gpu::Texture> still_;  ///< what the comparison has
    std::size_t shown_ = 0;                ///< texels that are in it
    std::string failure_;
    Background background_;
};

}  // namespace rowland::demo
