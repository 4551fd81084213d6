#include "modules/diffraction/runtime/rung_control.h"

#include <algorithm>
#include <utility>

#include "engine/render/gpu_mesh.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/quality.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::diffraction {

namespace {

/// What a draw costs besides the grating, in the units of shading_price(): the base, its light and its output.
constexpr double kBasePrice = 40.0;

/// Draws without a map, by a stand-in, are of another kind.
std::uint64_t kind_of(const GpuMaterial& material, bool without_map) {
    return reinterpret_cast<std::uintptr_t>(&material) | (without_map ? 1U : 0U);
}

double relative_error(const BudgetRecord& record) {
    return record.largest_error() / default_max_error(record.measure);
}

}  // namespace

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
    world.view<DrawnRung>().each([](ecs::Entity, DrawnRung& drawn) { drawn.samples = 0.0; });
    std::vector<DrawCosts::Run> taken;
    double ms = 0.0;
    for (const gpu::MeteredRun& run : runs) {
        DrawCosts::Run& total = taken.emplace_back(DrawCosts::Run{.kind = run.kind, .ms = run.gpu_ms});
        ms += run.gpu_ms;
        for (const gpu::MeteredRun::Draw& draw : run.draws) {
            const auto samples = static_cast<double>(draw.samples);
            total.samples += samples;
            if (DrawnRung* drawn = world.find<DrawnRung>(render::entity_of(draw.object)))
                drawn->samples = std::max(drawn->samples, samples);
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
    return static_cast<float>(drawn->fade_frame) / static_cast<float>(kFadeFrames + 1);
}

bool RungControl::announces(const DrawnRung& drawn, ecs::Entity entity) const {
    constexpr std::uint64_t kPeriod = 64;
    return drawn.announced != frame_ && (!drawn.announced || (frame_ + entity.index) % kPeriod == 0);
}

std::vector<RungOption> RungControl::options_of(const Candidate& candidate) const {
    const DrawnRung& drawn = *candidate.drawn;
    const auto option = [&](const Rung& rung) {
        return RungOption{.error = rung.error * candidate.samples,
                          .ms = costs_.ms(kind_of(*rung.material, false), candidate.samples)};
    };
    std::vector<RungOption> options;
    for (const Rung& rung : *drawn.ladder) options.push_back(option(rung));
    return options;
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
    std::vector<Candidate> recorded;
    double fixed_ms = 0.0;
    for (const render::LitEntity& lit : seen) {
        DrawnRung* drawn = world.find<DrawnRung>(lit.entity);
        if (drawn == nullptr) continue;
        drawn->may_fade = !lit.light.has_second();
        if (drawn->samples == 0.0) continue;
        const Candidate candidate{drawn, drawn->samples * (lit.light.has_second() ? 2.0 : 1.0)};
        if (drawn->fade_frame > 0 || drawn->recorded) fixed_ms += options_of(candidate)[drawn->wanted].ms;
        if (drawn->fade_frame == 0) (drawn->recorded ? recorded : candidates).push_back(candidate);
    }

    constexpr double kAim = 0.98;  // of the time, so that noise rarely exceeds it
    constexpr double kTooLong = 1.05;
    constexpr double kBetter = 0.9;  // of the error, worth a change
    constexpr double kMuchTooLong = 1.25;
    fade_step_ = report_.last_ms > kMuchTooLong * gratings_ms ? 2 : 1;
    std::vector<std::vector<RungOption>> options;
    double ms = fixed_ms;
    double error = 0.0;
    for (const Candidate& candidate : candidates) {
        options.push_back(options_of(candidate));
        ms += options.back()[candidate.drawn->wanted].ms;
        error += options.back()[candidate.drawn->wanted].error;
    }
    const std::vector<std::size_t> best = assign_rungs(options, kAim * gratings_ms - fixed_ms);
    double best_ms = fixed_ms;
    double best_error = 0.0;
    for (std::size_t i = 0; i < best.size(); ++i) {
        best_ms += options[i][best[i]].ms;
        best_error += options[i][best[i]].error;
    }
    if (ms > kTooLong * gratings_ms || best_error < kBetter * error) {
        for (std::size_t i = 0; i < best.size(); ++i) candidates[i].drawn->wanted = best[i];
        ms = best_ms;
    }
    candidates.insert(candidates.end(), recorded.begin(), recorded.end());
    write_report(candidates, ms);
}

void RungControl::write_report(std::span<const Candidate> candidates, double predicted_ms) {
    report_ = {.last_ms = report_.last_ms, .spent_ms = report_.spent_ms, .predicted_ms = predicted_ms};
    double samples = 0.0;
    for (const auto& [drawn, count] : candidates) {
        const Ladder& ladder = *drawn->ladder;
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
    if (drawn.fade_frame > 0 || ready) drawn.fade_frame += drawn.recorded ? 1 : fade_step_;
    if (drawn.may_fade && drawn.fade_frame <= kFadeFrames) return;
    if (ready) {
        const auto second = std::move(state.second);
        state = std::move(*second);
    }
    drawn.shown = drawn.wanted;
    drawn.fade_frame = 0;
}

}  // namespace rowland::diffraction
