#include "modules/diffraction/runtime/frame_budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
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

namespace {

/// From the rung that an object shows to another, or to the same.
struct Change {
    ObjectRungs* object;
    std::size_t to;

    const RungOption& before() const { return object->options[object->shown]; }
    const RungOption& after() const { return object->options[to]; }
    double saved_error() const { return before().error - after().error; }
};

/// Lets objects want the better rungs of `changes`, those that save the most error first, as long as the frame with all
/// that is shown and all that fades in takes no longer than `limit_ms`. One may change alone, however long it takes.
void begin_better(std::span<ObjectRungs> objects, std::vector<Change> changes, double limit_ms) {
    double drawn_ms = 0.0;
    bool any_changes = false;
    for (const ObjectRungs& object : objects) {
        const bool changes_rung = object.wanted != object.shown;
        drawn_ms += object.options[object.shown].ms + (changes_rung ? object.options[object.wanted].ms : 0.0);
        any_changes = any_changes || changes_rung;
    }
    std::ranges::stable_sort(changes, std::greater<>(), &Change::saved_error);
    for (const Change& change : changes) {
        if (change.to == change.object->shown || change.object->wanted != change.object->shown) continue;
        if (any_changes && drawn_ms + change.after().ms > limit_ms) continue;
        change.object->wanted = change.to;
        drawn_ms += change.after().ms;
        any_changes = true;
    }
}

}  // namespace

int fade_frames(double relative_error) {
    // A display value is about the radiance to the power of 1/2.2: a frame then changes it by 2/255 of white or less.
    constexpr double kFramesOfError = 75.0;
    return std::clamp(static_cast<int>(std::ceil(kFramesOfError * relative_error)), kLeastFadeFrames, kMostFadeFrames);
}

void RungChooser::choose(std::span<ObjectRungs> objects, double ms) {
    constexpr double kAim = 0.98;  // of the time, so that noise rarely exceeds it
    constexpr double kNearlyFastest = 1.02;
    constexpr double kMuchTooLong = 1.25;
    constexpr double kTooCoarse = 1.0 / 0.9;
    constexpr double kAmple = 0.8;               // of the time: what takes less changes for any gain
    constexpr int kPatienceWhenMuchTooLong = 2;  // frames
    constexpr int kPatienceWhenTooLong = 4;
    constexpr int kPatienceWhenTooCoarse = 8;

    double fixed_ms = 0.0;    // of the objects that fade, when they have
    double fastest_ms = 0.0;  // the least that the others can take
    std::vector<std::vector<RungOption>> options;
    std::vector<Change> changes;  // in the order of `options`
    for (ObjectRungs& object : objects) {
        if (object.fades) {
            fixed_ms += object.options[object.wanted].ms;
            continue;
        }
        fastest_ms += std::ranges::min(object.options, {}, &RungOption::ms).ms;
        options.push_back(object.options);
        changes.push_back({&object, 0});
    }
    const double limit_ms = std::max(ms, (fixed_ms + kNearlyFastest * fastest_ms) / kAim);
    const std::vector<std::size_t> best = assign_rungs(options, kAim * limit_ms - fixed_ms);
    double wanted_ms = fixed_ms;
    double wanted_error = 0.0;
    double best_ms = fixed_ms;
    double best_error = 0.0;
    for (std::size_t i = 0; i < best.size(); ++i) {
        changes[i].to = best[i];
        const RungOption& wanted = options[i][changes[i].object->wanted];
        wanted_ms += wanted.ms;
        wanted_error += wanted.error;
        best_ms += changes[i].after().ms;
        best_error += changes[i].after().error;
    }
    frames_too_long_ = wanted_ms > kTooLong * limit_ms ? frames_too_long_ + 1 : 0;
    const double tolerated = best_ms < kAmple * limit_ms ? 1.0 : kTooCoarse;
    frames_too_coarse_ = wanted_error > tolerated * best_error ? frames_too_coarse_ + 1 : 0;
    const int patience = wanted_ms > kMuchTooLong * limit_ms ? kPatienceWhenMuchTooLong : kPatienceWhenTooLong;
    const bool too_long = frames_too_long_ >= patience;
    const bool too_coarse = frames_too_coarse_ >= kPatienceWhenTooCoarse;
    if (!too_long && !too_coarse) return;

    for (const Change& change : changes)
        change.object->wanted = change.after().ms < change.before().ms ? change.to : change.object->shown;
    if (too_long) return;
    begin_better(objects, std::move(changes), limit_ms);
}

double DrawCosts::work(std::uint64_t kind, const DrawSize& size) const {
    const auto found = prices_.find(kind);
    if (found == prices_.end()) return 0.0;
    return found->second * size.samples + price_of_vertex_ * size.vertices;
}

void DrawCosts::learn(std::span<const Run> frame) {
    // The weight of a frame is small for noise and large for a new load.
    constexpr double kLeastOfLoad = 0.1;
    constexpr double kMostOfLoad = 0.7;
    constexpr double kOfPrice = 0.1;
    constexpr double kFewSamples = 2000.0;  // below, a run's time is that of its state changes
    double units = 0.0;
    double ms = 0.0;
    for (const Run& run : frame) {
        units += work(run.kind, run.size);
        ms += run.ms;
    }
    if (units <= 0.0 || ms <= 0.0) return;
    const double now = ms / units;
    if (ms_per_unit_ == 0.0) {
        recent_.fill(now);
        ms_per_unit_ = now;
    }
    recent_ = {recent_[1], recent_[2], now};
    std::array<double, 3> sorted = recent_;
    std::ranges::sort(sorted);
    const double middle = sorted[1];  // one slow frame is noise
    const double weight = std::clamp(3.0 * std::abs(std::log(middle / ms_per_unit_)), kLeastOfLoad, kMostOfLoad);
    ms_per_unit_ += weight * (middle - ms_per_unit_);
    for (const Run& run : frame) {
        const auto found = prices_.find(run.kind);
        if (found == prices_.end() || run.size.samples < kFewSamples) continue;
        const double of_samples = found->second * run.size.samples;
        const double of_vertices = price_of_vertex_ * run.size.vertices;
        if (of_samples < of_vertices) continue;
        const double ratio = std::clamp((run.ms / now - of_vertices) / of_samples, 0.25, 4.0);
        found->second *= std::pow(ratio, kOfPrice);
    }
}

double DrawCosts::ms(std::uint64_t kind, const DrawSize& size) const {
    return ms_per_unit_ * work(kind, size);
}

}  // namespace rowland::diffraction
