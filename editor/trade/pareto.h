#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rowland::trade {

/// A setting by two quantities, of which less is better.
struct TradePoint {
    double cost = 0.0;
    double error = 0.0;
};

/// The Pareto front: the points such that no other point is as good in both quantities and better in one, by ascending
/// cost. Of equal points the first. Points that are not finite are left out.
std::vector<std::size_t> pareto_front(std::span<const TradePoint> points);

}  // namespace rowland::trade
