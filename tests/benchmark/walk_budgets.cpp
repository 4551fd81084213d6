#include "tests/benchmark/walk_budgets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "engine/core/log.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::benchmark {

namespace {

constexpr double kNoLimit_ms = 1e9;
/// Frames that a budget takes to be met, and then those that are measured.
constexpr int kSettling = 2 * diffraction::kMostFadeFrames;
constexpr int kMeasured = 16;

struct Measured {
    double ms = 0.0;  ///< median
    double error = 0.0;
    double largest_step = 0.0;
    double settled_step = 0.0;
    std::map<std::string, double> samples;  ///< by representation
};

/// The largest change of a display value since the last frame, in 1/255.
class StepMeter {
 public:
    double take(const gpu::Framebuffer& target) {
        std::vector<glm::vec4> pixels = target.read_rgba_float();
        const double white = white_of(pixels);
        double largest = 0.0;
        for (std::size_t i = 0; i < before_.size(); ++i)
            for (int c = 0; c < 3; ++c)
                largest = std::max(largest,
                                   std::abs(display_value(pixels[i][c], white) - display_value(before_[i][c], white)));
        before_ = std::move(pixels);
        return largest;
    }

 private:
    std::vector<glm::vec4> before_;
};

Measured measure(Rooms& rooms, ecs::Entity holder, const scene::Camera& camera, const gpu::Framebuffer& target,
                 double budget_ms) {
    Measured measured;
    StepMeter steps;
    steps.take(target);
    rooms.world().add(holder, diffraction::FrameBudget{budget_ms});
    for (int frame = 0; frame < kSettling || diffraction::maps_are_filling(rooms.world()); ++frame) {
        rooms.draw_ms(camera, target);
        measured.largest_step = std::max(measured.largest_step, steps.take(target));
    }
    std::vector<double> times;
    for (int frame = 0; frame < kMeasured; ++frame) {
        rooms.draw_ms(camera, target);
        measured.settled_step = std::max(measured.settled_step, steps.take(target));
        const auto& report = rooms.world().get<diffraction::FrameBudgetReport>(holder);
        times.push_back(report.last_ms);
        measured.error = report.error;
    }
    measured.largest_step = std::max(measured.largest_step, measured.settled_step);
    measured.ms = diffraction::quantile(times, 0.5);
    rooms.world().view<diffraction::DrawnRung>().each([&](ecs::Entity, const diffraction::DrawnRung& drawn) {
        const diffraction::Rung& rung = drawn.rung();
        measured.samples[rung.mean_colour ? "mean colour" : info(rung.material->cooked()->tables).name] +=
            drawn.size.samples;
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
            budget.largest_step = std::max(budget.largest_step, measured.largest_step);
            budget.settled_step = std::max(budget.settled_step, measured.settled_step);
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
    std::printf("%8s %10s %10s %9s %13s %12s  %s\n", "part", "budget ms", "ms", "error ×", "largest step",
                "settled step", "pixels drawn by");
    for (const BudgetFrames& budget : budgets) {
        std::printf("%8.2f %10.2f %10.2f %9.3f %13.1f %12.1f ", budget.part, budget.budget_ms, budget.spent_ms,
                    budget.error, budget.largest_step, budget.settled_step);
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
                        {"largest_step", budget.largest_step},
                        {"settled_step", budget.settled_step},
                        {"pixels", budget.pixels}});
    return list;
}

}  // namespace rowland::benchmark
