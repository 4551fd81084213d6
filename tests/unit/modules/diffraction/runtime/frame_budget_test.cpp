#include "modules/diffraction/runtime/frame_budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace rowland::diffraction {
namespace {

using Objects = std::vector<std::vector<RungOption>>;

RungOption sum_of(const Objects& objects, const std::vector<std::size_t>& chosen) {
    RungOption sum;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        sum.error += objects[i][chosen[i]].error;
        sum.ms += objects[i][chosen[i]].ms;
    }
    return sum;
}

/// The least error within `ms`, of all assignments.
double exhaustive(const Objects& objects, double ms, std::size_t at = 0, double error = 0.0) {
    if (ms < 0.0) return std::numeric_limits<double>::infinity();
    if (at == objects.size()) return error;
    double least = std::numeric_limits<double>::infinity();
    for (const RungOption& option : objects[at])
        least = std::min(least, exhaustive(objects, ms - option.ms, at + 1, error + option.error));
    return least;
}

/// Ladders as materials have them: each rung more expensive and better than the one before, over objects of very
/// different size.
Objects random_objects(std::mt19937& random, int count) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    Objects objects;
    for (int i = 0; i < count; ++i) {
        const double pixels = std::pow(10.0, 3.0 + 2.5 * uniform(random));
        double ms = 1e-6 * (1.0 + uniform(random));
        double error = 1.0;
        std::vector<RungOption> options;
        const int rungs = 1 + static_cast<int>(6.0 * uniform(random));
        for (int rung = 0; rung < rungs; ++rung) {
            options.push_back({.error = error * pixels, .ms = ms * pixels});
            ms *= 1.1 + uniform(random);
            error *= 0.2 + 0.7 * uniform(random);
        }
        objects.push_back(std::move(options));
    }
    return objects;
}

TEST(AssignRungs, IsTheBestAssignmentOfAFewObjects) {
    std::mt19937 random(7);
    for (int i = 0; i < 200; ++i) {
        const Objects objects = random_objects(random, 1 + i % 6);
        double fastest = 0.0;
        double slowest = 0.0;
        for (const auto& options : objects) {
            fastest += options.front().ms;
            slowest += options.back().ms;
        }
        for (const double part : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0}) {
            const double ms = fastest + part * (slowest - fastest) + 1e-9;
            const RungOption sum = sum_of(objects, assign_rungs(objects, ms));
            EXPECT_LE(sum.ms, ms);
            EXPECT_LE(sum.error, exhaustive(objects, ms) * (1.0 + 1e-9)) << "case " << i << ", part " << part;
        }
    }
}

TEST(AssignRungs, WastesLittleOfTheTimeOfManyObjects) {
    std::mt19937 random(8);
    const Objects objects = random_objects(random, 1000);
    double slowest = 0.0;
    for (const auto& options : objects) slowest += options.back().ms;
    const RungOption sum = sum_of(objects, assign_rungs(objects, 0.6 * slowest));
    EXPECT_LE(sum.ms, 0.6 * slowest);
    EXPECT_GT(sum.ms, 0.599 * slowest);
}

TEST(AssignRungs, TakesTheFastestWhereEvenTheseTakeTooLong) {
    const Objects objects{{{.error = 3.0, .ms = 2.0}, {.error = 1.0, .ms = 4.0}}, {{.error = 5.0, .ms = 1.0}}};
    EXPECT_EQ(assign_rungs(objects, 0.0), (std::vector<std::size_t>{0, 0}));
    EXPECT_EQ(assign_rungs(objects, 1e9), (std::vector<std::size_t>{1, 0}));
    EXPECT_TRUE(assign_rungs({}, 1.0).empty());
}

TEST(AssignRungs, IgnoresRungsThatCostMoreAndAreNoBetter) {
    const Objects objects{{{.error = 1.0, .ms = 1.0}, {.error = 2.0, .ms = 3.0}, {.error = 0.5, .ms = 2.0}}};
    EXPECT_EQ(assign_rungs(objects, 1.5), (std::vector<std::size_t>{0}));
    EXPECT_EQ(assign_rungs(objects, 10.0), (std::vector<std::size_t>{2}));
}

/// Frames of a machine that takes `ns` per sample of each kind.
void learn(DrawCosts& costs, const std::vector<double>& ns, int frames) {
    for (int i = 0; i < frames; ++i) {
        std::vector<DrawCosts::Run> runs;
        for (std::size_t kind = 0; kind < ns.size(); ++kind)
            runs.push_back({.kind = kind + 1, .size = {.samples = 1e5}, .ms = ns[kind] * 0.1});
        costs.learn(runs);
    }
}

TEST(DrawCosts, LearnsWhatEachKindTakes) {
    DrawCosts costs(0.0);
    costs.expect(1, 40.0);
    costs.expect(2, 50.0);
    learn(costs, {20.0, 90.0}, 100);
    EXPECT_NEAR(costs.ms(1, {.samples = 1e6}), 20.0, 0.2);
    EXPECT_NEAR(costs.ms(2, {.samples = 1e6}), 90.0, 0.9);
}

TEST(DrawCosts, FollowsTheMachinesLoadForKindsThatAreNotDrawn) {
    DrawCosts costs(0.0);
    costs.expect(1, 40.0);
    costs.expect(2, 80.0);
    learn(costs, {10.0}, 50);
    EXPECT_NEAR(costs.ms(2, {.samples = 1e6}), 20.0, 0.2) << "by its price";
    learn(costs, {20.0}, 10);
    EXPECT_NEAR(costs.ms(1, {.samples = 1e6}), 20.0, 1.0);
    EXPECT_NEAR(costs.ms(2, {.samples = 1e6}), 40.0, 2.0);
}

TEST(DrawCosts, KnowsNothingAtFirst) {
    DrawCosts costs(0.0);
    costs.expect(1, 40.0);
    EXPECT_EQ(costs.ms(1, {.samples = 1e6}), 0.0);
    costs.learn({});
    EXPECT_EQ(costs.ms(1, {.samples = 1e6}), 0.0);
}

TEST(DrawCosts, OfManyVerticesAreNotTakenForThoseOfPixels) {
    DrawCosts costs(10.0);
    costs.expect(1, 40.0);
    costs.expect(2, 80.0);
    const DrawSize distant{.samples = 100.0, .vertices = 1e4};
    for (int i = 0; i < 50; ++i) costs.learn({{{.kind = 1, .size = distant, .ms = 1.04}}});
    EXPECT_NEAR(costs.ms(1, distant), 1.04, 1e-3);
    EXPECT_NEAR(costs.ms(2, distant), 1.08, 1e-3) << "a cheaper rung saves little";
    EXPECT_NEAR(costs.ms(2, {.samples = 1e5}), 80.0, 0.1);
}

/// A machine that draws objects, with a load and noise, and the choice of their rungs as the renderer makes it.
class Machine {
 public:
    /// `misjudged`: the largest factor by which a rung's estimated price is wrong.
    Machine(const Objects& objects, double misjudged, unsigned seed) : truth_(objects), random_(seed) {
        std::uniform_real_distribution<double> exponent(-1.0, 1.0);
        for (std::size_t i = 0; i < truth_.size(); ++i) {
            const std::size_t best = truth_[i].size() - 1;
            objects_.push_back({.options = truth_[i], .shown = best, .wanted = best});
            for (std::size_t rung = 0; rung <= best; ++rung)
                costs_.expect(kind(i, rung),
                              1e6 * std::pow(misjudged, exponent(random_)) * truth_[i][rung].ms / kSamples);
        }
        fade_.assign(truth_.size(), 0);
    }

    double free_ms() const { return sum(&RungOption::ms, true); }
    double fastest_ms() const { return sum(&RungOption::ms, false); }
    double error() const {
        double error = 0.0;
        for (const ObjectRungs& object : objects_) error += object.options[object.shown].error;
        return error;
    }

    /// Draws a frame; returns its time.
    double draw(double budget_ms, double load) {
        std::normal_distribution<double> noise(1.0, 0.02);
        std::normal_distribution<double> frame_noise(1.0, frame_noise_);
        load *= std::max(frame_noise(random_), 0.5);
        std::vector<DrawCosts::Run> runs;
        double ms = 0.0;
        const auto add = [&](std::size_t i, std::size_t rung) {
            const double taken = load * noise(random_) * truth_[i][rung].ms;
            runs.push_back({.kind = kind(i, rung), .size = {.samples = kSamples}, .ms = taken});
            ms += taken;
        };
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            add(i, objects_[i].shown);
            if (fade_[i] > 0) add(i, objects_[i].wanted);
        }
        costs_.learn(runs);
        changing_ = 0;
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            ObjectRungs& object = objects_[i];
            object.fades = fade_[i] > 0;
            for (std::size_t rung = 0; rung < object.options.size(); ++rung)
                object.options[rung].ms = costs_.ms(kind(i, rung), {.samples = kSamples});
        }
        chooser_.choose(objects_, budget_ms);
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            ObjectRungs& object = objects_[i];
            if (object.wanted == object.shown) continue;
            ++changing_;
            fade_[i] += std::min(ms, before_ms_) > kTooLong * budget_ms ? kMostFadeFrames / kLeastFadeFrames : 1;
            if (fade_[i] <= kMostFadeFrames) continue;
            object.shown = object.wanted;
            fade_[i] = 0;
        }
        return before_ms_ = ms;
    }
    /// From now on whole frames take longer or shorter than the others, with this standard deviation.
    void add_noise(double deviation) { frame_noise_ = deviation; }
    /// Objects that change their rung in the last frame.
    int changing() const { return changing_; }

 private:
    static constexpr double kSamples = 1e4;
    static std::uint64_t kind(std::size_t object, std::size_t rung) { return 100 * object + rung + 1; }
    double sum(double RungOption::*of, bool last) const {
        double total = 0.0;
        for (const auto& options : truth_) total += (last ? options.back() : options.front()).*of;
        return total;
    }

    Objects truth_;
    std::mt19937 random_;
    DrawCosts costs_{0.0};
    RungChooser chooser_;
    std::vector<ObjectRungs> objects_;
    std::vector<int> fade_;
    int changing_ = 0;
    double before_ms_ = 0.0;
    double frame_noise_ = 0.0;
};

Objects forty_objects() {
    std::mt19937 random(9);
    return random_objects(random, 40);
}

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

TEST(RungChooser, MeetsItsTimeAndLetsRungsRest) {
    const Objects objects = forty_objects();
    for (const double part : {0.15, 0.4, 0.8}) {
        Machine machine(objects, 1.4, 1);
        const double budget = machine.fastest_ms() + part * (machine.free_ms() - machine.fastest_ms());
        for (int frame = 0; frame < 1000; ++frame) machine.draw(budget, 1.0);
        std::vector<double> times;
        int changing = 0;
        for (int frame = 0; frame < 200; ++frame) {
            times.push_back(machine.draw(budget, 1.0));
            changing += machine.changing() > 0 ? 1 : 0;
        }
        EXPECT_NEAR(median(times), budget, 0.15 * budget) << part;
        EXPECT_EQ(changing, 0) << part;
        const double best = sum_of(objects, assign_rungs(objects, budget)).error;
        EXPECT_LT(machine.error(), best / 0.8) << part;
    }
}

TEST(RungChooser, ChangesFewRungsOfAMachineWithNoise) {
    const Objects objects = forty_objects();
    Machine machine(objects, 1.1, 4);
    const double budget = 0.5 * (machine.fastest_ms() + machine.free_ms());
    for (int frame = 0; frame < 300; ++frame) machine.draw(budget, 1.0);
    machine.add_noise(0.08);
    std::vector<double> times;
    int changing = 0;
    double error = 0.0;
    constexpr int kFrames = 600;
    for (int frame = 0; frame < kFrames; ++frame) {
        times.push_back(machine.draw(budget, 1.0));
        changing += machine.changing();
        error += machine.error() / kFrames;
    }
    EXPECT_NEAR(median(times), budget, 0.15 * budget);
    EXPECT_LT(changing, static_cast<int>(kFrames * objects.size() / 20));
    EXPECT_LT(error, sum_of(objects, assign_rungs(objects, budget)).error / 0.7);
}

TEST(RungChooser, MeetsASuddenLoadWithinTenFramesAndForGood) {
    Machine machine(forty_objects(), 1.03, 2);
    const double budget = 0.3 * machine.fastest_ms() + 0.7 * machine.free_ms();
    const double load = 1.4;
    ASSERT_LT(load * machine.fastest_ms(), 0.8 * budget);
    for (int frame = 0; frame < 600; ++frame) machine.draw(budget, 1.0);
    for (int frame = 0; frame < 10; ++frame) machine.draw(budget, load);
    for (int frame = 10; frame < 300; ++frame) EXPECT_LT(machine.draw(budget, load), 1.1 * budget) << frame;
}

TEST(RungChooser, LetsNoMoreFadeAtOnceThanTheTimeAllows) {
    Machine machine(forty_objects(), 1.03, 3);
    for (int frame = 0; frame < 300; ++frame) machine.draw(0.0, 1.0);
    EXPECT_LT(machine.draw(0.0, 1.0), 1.1 * machine.fastest_ms());
    const double cheap_error = machine.error();
    const double budget = 0.2 * machine.fastest_ms() + 0.8 * machine.free_ms();
    for (int frame = 0; frame < 800; ++frame) EXPECT_LT(machine.draw(budget, 1.0), 1.1 * budget) << frame;
    EXPECT_LT(machine.error(), 0.5 * cheap_error);
    EXPECT_EQ(machine.changing(), 0);
}

TEST(RungChooser, LeavesNothingCoarseWhereTimeIsAmple) {
    std::vector<ObjectRungs> objects{{.options = {{.error = 100.0, .ms = 1.0}}},
                                     {.options = {{.error = 0.2, .ms = 1.0}, {.error = 0.1, .ms = 2.0}}}};
    RungChooser chooser;
    for (int frame = 0; frame < 8; ++frame) chooser.choose(objects, 3.3);
    EXPECT_EQ(objects[1].wanted, 0U);
    for (int frame = 0; frame < 8; ++frame) chooser.choose(objects, 10.0);
    EXPECT_EQ(objects[1].wanted, 1U);
}

/// A budget that nothing meets does not make objects coarse for a saving that is none.
TEST(RungChooser, TakesATimeThatCannotBeKeptForALittleMoreThanTheLeast) {
    std::vector<ObjectRungs> objects{{.options = {{.error = 9.0, .ms = 1.0}, {.error = 1.0, .ms = 1.005}}},
                                     {.options = {{.error = 9.0, .ms = 1.0}, {.error = 1.0, .ms = 2.0}}}};
    for (ObjectRungs& object : objects) object.shown = object.wanted = 1;
    RungChooser chooser;
    for (int frame = 0; frame < 4; ++frame) chooser.choose(objects, 0.1);
    EXPECT_EQ(objects[0].wanted, 1U);
    EXPECT_EQ(objects[1].wanted, 0U);
}

}  // namespace
}  // namespace rowland::diffraction
