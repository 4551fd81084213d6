#include "tests/benchmark/walk_budgets.h"

#include <array>
#include <cstdio>

#include "engine/core/log.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::benchmark {

namespace {

constexpr double kNoLimit_ms = 1e9;
/// Frames that a budget takes to be met, and then those that are measured.
constexpr int kSettling = 48;
constexpr int kMeasured = 16;

struct Measured {
    double ms = 0.0;  ///< median
    double error = 0.0;
    std::map<std::string, double> samples;  ///< by representation
};

Measured measure(Rooms& rooms, ecs::Entity holder, const scene::Camera& camera, const gpu::Framebuffer& target,
                 double budget_ms) {
    rooms.world().add(holder, diffraction::FrameBudget{budget_ms});
    for (int frame = 0; frame < kSettling || diffraction::maps_are_filling(rooms.world()); ++frame)
        rooms.draw_ms(camera, target);
    Measured measured;
    std::vector<double> times;
    for (int frame = 0; frame < kMeasured; ++frame) {
        rooms.draw_ms(camera, target);
        const auto& report = rooms.world().get<diffraction::FrameBudgetReport>(holder);
        times.push_back(report.last_ms);
        measured.error = report.error;
    }
    measured.ms = diffraction::quantile(times, 0.5);
    rooms.world().view<diffraction::DrawnRung>().each([&](ecs::Entity, const diffraction::DrawnRung& drawn) {
        measured.samples[info(drawn.material()->cooked()->tables).name] += drawn.samples;
    });
    return measured;
}

}  // namespace

std::vector<BudgetFrames> draw_under_budgets(const WalkOptions& options, int stops) {
    constexpr std::array kParts = {1.0, 0.75, 0.5, 0.25, 0.1};
    Rooms rooms(options, std::nullopt);
    const gpu::Framebuffer target(
        {.width = options.size.x, .height = options.size.y, .colours = {gpu::Format::RGBA16F}, .depth = true});
    const ecs::Entity holder = rooms.world().create();
    std::vector<BudgetFrames> budgets;
    for (const double part : kParts) budgets.push_back({.part = part, .pixels = {}});
    Progress progress("stops within budgets", static_cast<std::size_t>(stops));
    double all_samples = 0.0;
    for (int stop = 0; stop < stops; ++stop) {
        const scene::Camera camera = camera_at_stop(stop, stops);
        const double free_ms = measure(rooms, holder, camera, target, kNoLimit_ms).ms;
        double samples = 0.0;
        for (BudgetFrames& budget : budgets) {
            const double ms = budget.part * free_ms;
            const Measured measured = measure(rooms, holder, camera, target, budget.part < 1.0 ? ms : kNoLimit_ms);
            samples = 0.0;
            for (const auto& [name, count] : measured.samples) {
                budget.pixels[name] += count;
                samples += count;
            }
            budget.budget_ms += ms / stops;
            budget.spent_ms += measured.ms / stops;
            budget.error += measured.error * samples;
        }
        all_samples += samples;
        progress.advance();
    }
    for (BudgetFrames& budget : budgets) {
        double samples = 0.0;
        for (const auto& [name, count] : budget.pixels) samples += count;
        for (auto& [name, count] : budget.pixels) count /= samples;
        budget.error /= all_samples;
    }
    return budgets;
}

void print_budgets(const std::vector<BudgetFrames>& budgets) {
    std::printf("%8s %10s %10s %9s  %s\n", "part", "budget ms", "ms", "error ×", "pixels drawn by");
    for (const BudgetFrames& budget : budgets) {
        std::printf("%8.2f %10.2f %10.2f %9.3f ", budget.part, budget.budget_ms, budget.spent_ms, budget.error);
        for (const auto& [name, part] : budget.pixels) std::printf(" %s %.0f %%", name.c_str(), 100.0 * part);
        std::printf("\n");
    }
}

nlohmann::ordered_json budgets_json(const std::vector<BudgetFrames>& budgets) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const BudgetFrames& budget : budgets)
        list.push_back({{"part", budget.part},
                        {"budget_ms", budget.budget_ms},
                        {"spent_ms", budget.spent_ms},
                        {"error", budget.error},
                        {"pixels", budget.pixels}});
    return list;
}

}  // namespace rowland::benchmark
