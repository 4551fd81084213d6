#include "modules/diffraction/runtime/frame_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rowland::diffraction {

namespace {

/// The options of an object that no mixture of two others beats, from the fastest on: times ascend, errors descend, and
/// so does the error saved per time.
std::vector<std::size_t> convex_front(const std::vector<RungOption>& options) {
    std::vector<std::size_t> order(options.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(options[i].ms, options[i].error); });
    std::vector<std::size_t> front;
    for (const std::size_t i : order) {
        if (!front.empty() && options[i].error >= options[front.back()].error) continue;
        while (front.size() >= 2) {
            const RungOption& a = options[front[front.size() - 2]];
            const RungOption& b = options[front.back()];
            if ((a.error - b.error) * (options[i].ms - b.ms) >= (b.error - options[i].error) * (b.ms - a.ms)) break;
            front.pop_back();
        }
        front.push_back(i);
    }
    return front;
}

/// A step of one object from an option of its front to the next.
struct Step {
    std::size_t object;
    std::size_t to;  ///< index into the front
    double saved;    ///< error per time
};

/// Depth-first search for the least error. The bound is a Lagrangian relaxation, whose multiplier is the steps'
/// efficiency at which the time was used up.
class Search {
 public:
    Search(std::span<const std::vector<RungOption>> objects, double ms, double efficiency,
           std::vector<std::size_t> known)
        : objects_(objects), efficiency_(efficiency), best_(std::move(known)), options_(objects.size(), 0) {
        order_.resize(objects.size());
        std::iota(order_.begin(), order_.end(), 0U);
        const auto spread = [&](std::size_t i) {
            const auto [low, high] = std::ranges::minmax(objects_[i], {}, &RungOption::error);
            return high.error - low.error;
        };
        std::ranges::sort(order_, std::greater<>(), spread);
        least_.assign(objects.size() + 1, 0.0);
        fastest_.assign(objects.size() + 1, 0.0);
        for (std::size_t i = objects.size(); i-- > 0;) {
            double least = std::numeric_limits<double>::infinity();
            double fastest = least;
            for (const RungOption& option : objects_[order_[i]]) {
                least = std::min(least, option.error + efficiency_ * option.ms);
                fastest = std::min(fastest, option.ms);
            }
            least_[i] = least_[i + 1] + least;
            fastest_[i] = fastest_[i + 1] + fastest;
        }
        for (std::size_t i = 0; i < objects.size(); ++i) best_error_ += objects[i][best_[i]].error;
        visit(0, 0.0, ms);
    }

    std::vector<std::size_t> best() && { return std::move(best_); }

 private:
    void visit(std::size_t depth, double error, double ms_left) {
        constexpr int kMostVisits = 2000;
        if (ms_left < fastest_[depth] || ++visits_ > kMostVisits) return;
        if (error + least_[depth] - efficiency_ * ms_left >= best_error_ * (1.0 - 1e-9)) return;
        if (depth == order_.size()) {
            if (error >= best_error_) return;
            best_ = options_;
            best_error_ = error;
            return;
        }
        const std::size_t object = order_[depth];
        for (std::size_t i = objects_[object].size(); i-- > 0;) {
            options_[object] = i;
            visit(depth + 1, error + objects_[object][i].error, ms_left - objects_[object][i].ms);
        }
    }

    std::span<const std::vector<RungOption>> objects_;
    double efficiency_;
    std::vector<std::size_t> order_;  ///< the objects whose choice matters most first
    std::vector<double> least_;       ///< of the objects from a depth on: error + efficiency · ms
    std::vector<double> fastest_;     ///< ms
    std::vector<std::size_t> best_;
    double best_error_ = 0.0;
    std::vector<std::size_t> options_;
    int visits_ = 0;
};

}  // namespace

std::vector<std::size_t> assign_rungs(std::span<const std::vector<RungOption>> objects, double ms) {
    std::vector<std::vector<std::size_t>> fronts;
    std::vector<std::size_t> at(objects.size(), 0);  // index into the front
    std::vector<Step> steps;
    double left = ms;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        fronts.push_back(convex_front(objects[i]));
        const std::vector<std::size_t>& front = fronts.back();
        left -= objects[i][front[0]].ms;
        for (std::size_t to = 1; to < front.size(); ++to) {
            const RungOption& a = objects[i][front[to - 1]];
            const RungOption& b = objects[i][front[to]];
            steps.push_back({i, to, (a.error - b.error) / std::max(b.ms - a.ms, 1e-12)});
        }
    }
    std::ranges::stable_sort(steps, std::greater<>(), &Step::saved);
    double efficiency = 0.0;  // of the first step that there is no time for
    for (const Step& step : steps) {
        if (at[step.object] + 1 != step.to) continue;
        const double longer = objects[step.object][fronts[step.object][step.to]].ms -
                              objects[step.object][fronts[step.object][step.to - 1]].ms;
        if (longer > left) {
            efficiency = std::max(efficiency, step.saved);
            continue;
        }
        left -= longer;
        at[step.object] = step.to;
    }
    for (std::size_t i = 0; i < objects.size(); ++i) at[i] = fronts[i][at[i]];
    if (efficiency == 0.0 || left < 0.0) return at;
    return Search(objects, ms, efficiency, std::move(at)).best();
}

double DrawCosts::price(std::uint64_t kind) const {
    const auto found = prices_.find(kind);
    return found == prices_.end() ? 0.0 : found->second;
}

void DrawCosts::learn(std::span<const Run> frame) {
    // The weight of a new frame is small for noise and large for a new load.
    constexpr double kLeastOfLoad = 0.1;
    constexpr double kMostOfLoad = 0.5;
    constexpr double kOfPrice = 0.1;
    constexpr double kFewSamples = 2000.0;  // below, a run's time is that of its state changes
    double units = 0.0;
    double ms = 0.0;
    for (const Run& run : frame) {
        units += price(run.kind) * run.samples;
        ms += run.ms;
    }
    if (units <= 0.0 || ms <= 0.0) return;
    const double now = ms / units;
    if (ms_per_unit_ == 0.0) ms_per_unit_ = now;
    const double weight = std::clamp(2.0 * std::abs(std::log(now / ms_per_unit_)), kLeastOfLoad, kMostOfLoad);
    ms_per_unit_ += weight * (now - ms_per_unit_);
    for (const Run& run : frame) {
        const auto found = prices_.find(run.kind);
        if (found == prices_.end() || run.samples < kFewSamples) continue;
        const double ratio = std::clamp(run.ms / (found->second * run.samples * now), 0.25, 4.0);
        found->second *= std::pow(ratio, kOfPrice);
    }
}

double DrawCosts::ms(std::uint64_t kind, double samples) const {
    return ms_per_unit_ * price(kind) * samples;
}

}  // namespace rowland::diffraction
