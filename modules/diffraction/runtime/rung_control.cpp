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

/// What a draw costs besides the grating, in the units of shading_price(): the base, its light and its output.
constexpr double kBasePrice = 40.0;
/// What a vertex costs: a third of a pixel of the base by AMD's compiler, a fifteenth on llvmpipe.
constexpr double kVertexPrice = 5.0;

/// Draws without a map, by a stand-in, are of another kind.
std::uint64_t kind_of(const GpuMaterial& material, bool without_map) {
    return reinterpret_cast<std::uintptr_t>(&material) | (without_map ? 1U : 0U);
}

double relative_error(const BudgetRecord& record) {
    return record.largest_error() / default_max_error(record.measure);
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
                           .price = rung.measured.price});
    ladder->push_back({.material = material});
    if (cooked.measured) {
        ladder->back().error = relative_error(*cooked.measured);
        ladder->back().price = cooked.measured->price;
    }
    for (const Rung& rung : *ladder)
        for (const bool without_map : {false, true})
            costs_.expect(kind_of(*rung.material, without_map), kBasePrice + rung.price);
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
    return kind_of(*drawn.material, drawn.without_map);
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
                                 .ms = costs_.ms(kind_of(*rung.material, false), candidate.size)});
    return rungs;
}

void RungControl::choose(ecs::World& world, std::span<const render::LitEntity> seen, double gratings_ms) {
    ++frame_;
    world.view<DiffractionSurface, render::MeshInstance>().each(
        [&](ecs::Entity entity, const DiffractionSurface& surface, const render::MeshInstance&) {
            DrawnRung* drawn = world.find<DrawnRung>(entity);
            if (drawn == nullptr || drawn->ladder->back().material != surface.material) {
                DrawnRung made{.ladder = ladder_of(surface.material)};
                made.shown = made.wanted = made.ladder->size() - 1;
                drawn = &world.add(entity, std::move(made));
            }
            drawn->may_fade = false;
            const RecordedRung* recorded = world.find<RecordedRung>(entity);
            drawn->recorded = recorded != nullptr;
            if (recorded != nullptr && drawn->fade_frame == 0)
                drawn->wanted = std::min(recorded->rung, drawn->ladder->size() - 1);
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
    }
    chooser_.choose(objects, gratings_ms);
    double ms = 0.0;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        candidates[i].drawn->wanted = objects[i].wanted;
        ms += objects[i].options[objects[i].wanted].ms;
    }
    write_report(candidates, ms);

    // One slow frame is noise.
    const double ms_at_least = std::min(report_.last_ms, std::exchange(ms_before_, report_.last_ms));
    urgent_ = ms_at_least > kTooLong * gratings_ms;
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
    const bool ready = state.fades && state.second && state.second->material == drawn.next_material() &&
                       state.second->light_version && !state.second->without_map;
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
