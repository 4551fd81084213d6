#include "editor/trade/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rowland::trade {

std::vector<std::size_t> pareto_front(std::span<const TradePoint> points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order,
                  [&](std::size_t i) { return !std::isfinite(points[i].cost) || !std::isfinite(points[i].error); });
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (points[a].cost != points[b].cost) return points[a].cost < points[b].cost;
        return points[a].error < points[b].error;
    });
    std::vector<std::size_t> front;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order)
        if (points[i].error < least) {
            least = points[i].error;
            front.push_back(i);
        }
    return front;
}

}  // namespace rowland::trade
