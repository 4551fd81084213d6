#include "modules/diffraction/bake/wavelength_cuts.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"

namespace rowland::diffraction {

std::vector<std::size_t> equal_weight_cuts(std::span<const double> weight, int parts) {
    const auto count = static_cast<std::size_t>(parts);
    ROWLAND_CHECK(parts >= 1 && count < weight.size(), "every part takes a step");
    std::vector<double> cumulative(weight.size(), 0.0);
    for (std::size_t j = 1; j < weight.size(); ++j)
        cumulative[j] = cumulative[j - 1] + 0.5 * (weight[j - 1] + weight[j]);
    std::vector<std::size_t> cuts = {0};
    for (std::size_t k = 1; k < count; ++k) {
        const double target = cumulative.back() * static_cast<double>(k) / static_cast<double>(count);
        auto above = static_cast<std::size_t>(std::lower_bound(cumulative.begin(), cumulative.end(), target) -
                                              cumulative.begin());
        if (above > 0 && target - cumulative[above - 1] < cumulative[above] - target) --above;
        cuts.push_back(std::clamp(above, cuts.back() + 1, weight.size() - 1 - (count - k)));
    }
    cuts.push_back(weight.size() - 1);
    return cuts;
}

}  // namespace rowland::diffraction
