#include "editor/trade/pareto.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace rowland::trade {
namespace {

TEST(ParetoFront, HoldsWhatNothingBeatsInBoth) {
    const std::vector<TradePoint> points = {{3.0, 1.0}, {1.0, 5.0}, {2.0, 6.0}, {2.0, 3.0}, {4.0, 1.0}};
    EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1, 3, 0}));
}

TEST(ParetoFront, TakesTheFirstOfEqualPointsAndNoneThatIsNotFinite) {
    const double infinite = std::numeric_limits<double>::infinity();
    const std::vector<TradePoint> points = {{infinite, 0.1}, {1.0, 2.0}, {1.0, 2.0}, {0.5, std::nan("")}};
    EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1}));
    EXPECT_TRUE(pareto_front({}).empty());
}

/// Against its definition, pair by pair.
TEST(ParetoFront, AgreesWithItsDefinition) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> value(0, 9);
    std::vector<TradePoint> points;
    for (int i = 0; i < 60; ++i) points.push_back({1.0 * value(random), 1.0 * value(random)});
    std::vector<bool> on_front(points.size(), false);
    for (const std::size_t i : pareto_front(points)) on_front[i] = true;
    for (std::size_t i = 0; i < points.size(); ++i) {
        bool beaten = false;
        for (std::size_t j = 0; j < points.size(); ++j) {
            const bool no_worse = points[j].cost <= points[i].cost && points[j].error <= points[i].error;
            const bool better = points[j].cost < points[i].cost || points[j].error < points[i].error;
            beaten = beaten || (no_worse && (better || j < i));
        }
        EXPECT_EQ(on_front[i], !beaten) << i;
    }
}

}  // namespace
}  // namespace rowland::trade
