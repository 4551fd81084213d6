#include "modules/diffraction/runtime/rung_control.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "engine/render/gpu_mesh.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/quality.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::diffraction {

namespace {

/// What a pixel costs besides the grating, in the units of shading_price(): the base, its light and its output.
constexpr double kBasePrice = 40.0;
/// A pixel of the mean colour.
constexpr double kMeanColourPrice = 5.0;
/// What a vertex costs: a third of a pixel of the base by AMD's compiler, a fifteenth on llvmpipe.
constexpr double kVertexPrice = 5.0;

/// Draws without a map, by a stand-in, are of another kind. All materials' mean colours are of one.
std::uint64_t kind_of(const GpuMaterial& material, bool mean_colour, bool without_map) {
    if (mean_colour) return 2;
    return reinterpret_cast<std::uintptr_t>(&material) | (without_map ? 1U : 0U);
}

double relative_error(const BudgetRecord& record) {
    return record.largest_error() / default_max_error(record.measure);
}

/// The recorded rung, or the best one.
std::size_t rung_in(const Ladder& ladder, const RecordedRung* recorded) {
    const std::size_t best = ladder.size() - 1;
    return recorded == nullptr ? best : std::min(recorded->rung, best);
}

}  // namespace

RungControl::RungControl(const glm::dmat3& xyz_to_working) : xyz_to_working_(xyz_to_working), costs_(kVertexPrice) {}

int DrawnRung::frames_of_fade() const {
    return fade_frames(default_max_error(ErrorMeasure::RelativeRms) *
                       std::max((*ladder)[shown].error, (*ladder)[wanted].error));
}

std::shared_ptr<const Ladder> RungControl::ladder_of(const std::shared_ptr<const GpuMaterial>& material) {
    std::weak_ptr<const Ladder>& kept = ladders_[material.get()];
    if (auto present = kept.lock()) return present;
    auto ladder = std::make_shared<Ladder>();
    const CookedMaterial& cooked = *material->cooked();
    for (const CookedRung& rung : cooked.cheaper)
        ladder->push_back({.material = make_gpu_material(as_rung(cooked, rung), xyz_to_working_),
                           .error = relative_error(rung.measured),
                           .price = kBasePrice + rung.measured.price});
    ladder->push_back({.material = material, .price = kBasePrice});
    if (cooked.measured) {
        ladder->back().error = relative_error(*cooked.measured);
        ladder->back().price += cooked.measured->price;
    }
    if (!material->base().passes_light) {
        const double of_black = 1.0 / default_max_error(ErrorMeasure::RelativeRms);
        const double largest = std::ranges::max(*ladder, {}, &Rung::error).error;
        ladder->insert(ladder->begin(), {.material = material,
                                         .error = std::max(of_black, largest),
                                         .price = kMeanColourPrice,
                                         .mean_colour = true});
    }
    for (const Rung& rung : *ladder)
        for (const bool without_map : {false, true})
            costs_.expect(kind_of(*rung.material, rung.mean_colour, without_map), rung.price);
    kept = ladder;
    return ladder;
}

void RungControl::take(ecs::World& world, std::span<const gpu::MeteredRun> runs) {
    constexpr double kOfFrame = 0.1;
    world.view<DrawnRung>().each([](ecs::Entity, DrawnRung& drawn) { drawn.size = {}; });
    std::vector<DrawCosts::Run> taken;
    double ms = 0.0;
    for (const gpu::MeteredRun& run : runs) {
        DrawCosts::Run& total = taken.emplace_back(DrawCosts::Run{.kind = run.kind, .ms = run.gpu_ms});
        ms += run.gpu_ms;
        for (const gpu::MeteredRun::Draw& draw : run.draws) {
            const auto samples = static_cast<double>(draw.samples);
            total.size.samples += samples;
            const ecs::Entity entity = render::entity_of(draw.object);
            DrawnRung* drawn = world.find<DrawnRung>(entity);
            if (drawn == nullptr) continue;
            drawn->size = {.samples = std::max(drawn->size.samples, samples),
                           .vertices = static_cast<double>(world.get<SurfaceState>(entity).mesh->positions.size())};
            total.size.vertices += drawn->size.vertices;
        }
    }
    report_.last_ms = ms;
    report_.spent_ms = report_.spent_ms == 0.0 ? ms : report_.spent_ms + kOfFrame * (ms - report_.spent_ms);
    costs_.learn(taken);
}

std::uint64_t RungControl::kind(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) const {
    const SurfaceState& drawn = world.get<SurfaceState>(entity).in(slot);
    return kind_of(*drawn.material, drawn.mean_colour, drawn.without_map);
}

std::optional<float> RungControl::second_part(ecs::World& world, ecs::Entity entity) const {
    const DrawnRung* drawn = world.find<DrawnRung>(entity);
    if (drawn == nullptr || drawn->fade_frame == 0) return std::nullopt;
    // Slow at both ends, where the eye sees a small part of one rung if the other is dark.
    const float time = static_cast<float>(drawn->fade_frame) / static_cast<float>(drawn->frames_of_fade() + 1);
    return glm::smoothstep(0.0F, 1.0F, time);
}

bool RungControl::announces(const DrawnRung& drawn, ecs::Entity entity) const {
    constexpr std::uint64_t kPeriod = 64;
    return drawn.announced != frame_ && (!drawn.announced || (frame_ + entity.index) % kPeriod == 0);
}

ObjectRungs RungControl::rungs_of(const Candidate& candidate) const {
    const DrawnRung& drawn = *candidate.drawn;
    ObjectRungs rungs{.shown = drawn.shown, .wanted = drawn.wanted, .fades = drawn.fade_frame > 0 || drawn.recorded};
    for (const Rung& rung : *drawn.ladder)
        rungs.options.push_back({.error = rung.error * candidate.size.samples,
                                 .ms = costs_.ms(kind_of(*rung.material, rung.mean_colour, false), candidate.size)});
    return rungs;
}

void RungControl::choose(ecs::World& world, std::span<const render::LitEntity> seen, double gratings_ms) {
    ++frame_;
    world.view<DiffractionSurface, render::MeshInstance>().each(
        [&](ecs::Entity entity, const DiffractionSurface& surface, const render::MeshInstance&) {
            DrawnRung* drawn = world.find<DrawnRung>(entity);
            const RecordedRung* recorded = world.find<RecordedRung>(entity);
            if (drawn == nullptr || drawn->ladder->back().material != surface.material) {
                DrawnRung made{.ladder = ladder_of(surface.material)};
                made.shown = made.wanted = rung_in(*made.ladder, recorded);
                drawn = &world.add(entity, std::move(made));
            }
            drawn->may_fade = false;
            drawn->recorded = recorded != nullptr;
            if (recorded != nullptr && drawn->fade_frame == 0) drawn->wanted = rung_in(*drawn->ladder, recorded);
        });
    std::vector<Candidate> candidates;
    std::vector<ObjectRungs> objects;
    for (const render::LitEntity& lit : seen) {
        DrawnRung* drawn = world.find<DrawnRung>(lit.entity);
        if (drawn == nullptr) continue;
        drawn->may_fade = !lit.light.has_second();
        if (drawn->size.samples == 0.0) continue;
        const double slots = lit.light.has_second() ? 2.0 : 1.0;
        candidates.push_back(
            {drawn, {.samples = slots * drawn->size.samples, .vertices = slots * drawn->size.vertices}});
        objects.push_back(rungs_of(candidates.back()));
        // Between two probes a rung would have to change at once.
        if (!drawn->may_fade && !urgent_) {
            objects.back().wanted = drawn->shown;
            objects.back().fades = true;
        }
    }
    chooser_.choose(objects, gratings_ms);
    double ms = 0.0;
    double fastest_ms = 0.0;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const std::vector<RungOption>& options = objects[i].options;
        candidates[i].drawn->wanted = objects[i].wanted;
        ms += options[objects[i].wanted].ms;
        fastest_ms += std::ranges::min(options, {}, &RungOption::ms).ms;
    }
    write_report(candidates, ms);

    // One slow frame is noise. A time that cannot be met does not hurry.
    const double ms_at_least = std::min(report_.last_ms, std::exchange(ms_before_, report_.last_ms));
    urgent_ = ms_at_least > kTooLong * std::max(gratings_ms, fastest_ms);
}

void RungControl::write_report(std::span<const Candidate> candidates, double predicted_ms) {
    report_ = {.last_ms = report_.last_ms, .spent_ms = report_.spent_ms, .predicted_ms = predicted_ms};
    double samples = 0.0;
    for (const auto& [drawn, size] : candidates) {
        const Ladder& ladder = *drawn->ladder;
        const double count = size.samples;
        const double least = std::ranges::min(ladder, {}, &Rung::error).error;
        ++report_.objects;
        if (ladder[drawn->wanted].error == least) ++report_.at_best;
        report_.error += ladder[drawn->wanted].error * count;
        report_.least_error += least * count;
        samples += count;
    }
    if (samples == 0.0) return;
    report_.error /= samples;
    report_.least_error /= samples;
}

void RungControl::step_fade(DrawnRung& drawn, SurfaceState& state) const {
    if (!drawn.changes()) return;
    const bool ready = state.fades && state.second && state.second->material == drawn.next_rung().material &&
                       state.second->mean_colour == drawn.next_rung().mean_colour && state.second->light_version &&
                       !state.second->without_map;
    const int frames = drawn.frames_of_fade();
    if (drawn.fade_frame > 0 || ready)
        drawn.fade_frame += urgent_ && !drawn.recorded ? (frames + kLeastFadeFrames - 1) / kLeastFadeFrames : 1;
    if (drawn.may_fade && drawn.fade_frame <= frames) return;
    if (ready) {
        const auto second = std::move(state.second);
        state = std::move(*second);
    }
    drawn.shown = drawn.wanted;
    drawn.fade_frame = 0;
}

}  // namespace rowland::diffraction
