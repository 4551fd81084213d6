#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/gpu/draw_meter.h"
#include "engine/gpu/program.h"
#include "engine/render/material.h"
#include "modules/diffraction/runtime/frame_budget.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::diffraction {

/// A way to draw a material.
struct Rung {
    std::shared_ptr<const GpuMaterial> material;
    double error = 0.0;  ///< the largest that was measured, as a multiple of what budgets ask for by default
    double price = 0.0;  ///< of a pixel, in the units of shading_price()
    bool mean_colour = false;
};
/// From the cheapest to the material itself. The first one of an opaque material is its mean colour, whose error counts
/// as that of a black grating, or of its worst other rung.
using Ladder = std::vector<Rung>;

/// Component: the rung that draws an object. While it fades to another, SurfaceState::second has that.
struct DrawnRung {
    std::shared_ptr<const Ladder> ladder;
    std::size_t shown = 0;
    std::size_t wanted = 0;
    int fade_frame = 0;                           ///< of fade_frames(); 0: it does not fade
    DrawSize size = {};                           ///< of its last draw
    bool recorded = false;                        ///< it has a RecordedRung
    bool may_fade = false;                        ///< it is seen, and under one probe: another has the second slot
    std::optional<std::uint64_t> announced = {};  ///< frame in which later_programs() named the rungs' programs

    bool changes() const { return wanted != shown; }
    int frames_of_fade() const;
    const Rung& rung() const { return (*ladder)[shown]; }
    const Rung& next_rung() const { return (*ladder)[wanted]; }
};

/// Chooses the rungs of all objects in each frame so that their draws take no longer than a FrameBudget, as measured.
class RungControl final : public render::DrawControl {
 public:
    explicit RungControl(const glm::dmat3& xyz_to_working);

    void take(ecs::World& world, std::span<const gpu::MeteredRun> runs) override;
    std::uint64_t kind(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) const override;
    std::optional<float> second_part(ecs::World& world, ecs::Entity entity) const override;

    /// Once a frame, before the objects are updated: gives each of them a DrawnRung.
    void choose(ecs::World& world, std::span<const render::LitEntity> seen, double gratings_ms);
    /// Begins, continues or ends the fade of an object, or changes at once one that may not fade.
    void step_fade(DrawnRung& drawn, SurfaceState& state) const;
    /// Whether the frame should announce the programs of an object's rungs: at first, and every 64th frame, as the
    /// scene's lights may ask for others.
    bool announces(const DrawnRung& drawn, ecs::Entity entity) const;
    std::uint64_t frame() const { return frame_; }
    const FrameBudgetReport& report() const { return report_; }

 private:
    /// A seen object whose samples were counted.
    struct Candidate {
        DrawnRung* drawn;
        DrawSize size;  ///< of both slots
    };

    std::shared_ptr<const Ladder> ladder_of(const std::shared_ptr<const GpuMaterial>& material);
    ObjectRungs rungs_of(const Candidate& candidate) const;
    void write_report(std::span<const Candidate> candidates, double predicted_ms);

    glm::dmat3 xyz_to_working_;
    std::map<const GpuMaterial*, std::weak_ptr<const Ladder>> ladders_;
    DrawCosts costs_;
    RungChooser chooser_;
    FrameBudgetReport report_;
    std::uint64_t frame_ = 0;
    double ms_before_ = 0.0;  ///< FrameBudgetReport::last_ms of the frame before
    /// The time is exceeded and can be met: all fades end within kLeastFadeFrames, and objects between two probes change
    /// at once.
    bool urgent_ = false;
};

}  // namespace rowland::diffraction
