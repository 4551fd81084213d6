#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rowland::diffraction {

/// Cuts a weight ≥ 0, given at equal steps, into `parts` intervals of nearly equal integral (trapezoid), each at least
/// one step long: parts + 1 node indices from 0 to the last. 1 ≤ parts < weight.size().
std::vector<std::size_t> equal_weight_cuts(std::span<const double> weight, int parts);

/// Calls use(j, weight) for the nodes of an interval, with the weights of the trapezoid rule in steps.
template <typename Use>
void each_node(std::size_t begin, std::size_t end, const Use& use) {
    for (std::size_t j = begin; j <= end; ++j) use(j, j == begin || j == end ? 0.5 : 1.0);
}

}  // namespace rowland::diffraction
