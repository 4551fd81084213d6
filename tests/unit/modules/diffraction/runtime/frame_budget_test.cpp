#include "modules/diffraction/runtime/frame_budget.h"

#include <gtest/gtest.h>

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
            runs.push_back({.kind = kind + 1, .samples = 1e5, .ms = ns[kind] * 0.1});
        costs.learn(runs);
    }
}

TEST(DrawCosts, LearnsWhatEachKindTakes) {
    DrawCosts costs;
    costs.expect(1, 40.0);
    costs.expect(2, 50.0);
    learn(costs, {20.0, 90.0}, 100);
    EXPECT_NEAR(costs.ms(1, 1e6), 20.0, 0.2);
    EXPECT_NEAR(costs.ms(2, 1e6), 90.0, 0.9);
}

TEST(DrawCosts, FollowsTheMachinesLoadForKindsThatAreNotDrawn) {
    DrawCosts costs;
    costs.expect(1, 40.0);
    costs.expect(2, 80.0);
    learn(costs, {10.0}, 50);
    EXPECT_NEAR(costs.ms(2, 1e6), 20.0, 0.2) << "by its price";
    learn(costs, {20.0}, 10);
    EXPECT_NEAR(costs.ms(1, 1e6), 20.0, 1.0);
    EXPECT_NEAR(costs.ms(2, 1e6), 40.0, 2.0);
}

TEST(DrawCosts, KnowsNothingAtFirst) {
    DrawCosts costs;
    costs.expect(1, 40.0);
    EXPECT_EQ(costs.ms(1, 1e6), 0.0);
    costs.learn({});
    EXPECT_EQ(costs.ms(1, 1e6), 0.0);
}

}  // namespace
}  // namespace rowland::diffraction
