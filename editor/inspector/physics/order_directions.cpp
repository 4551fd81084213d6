#include "editor/inspector/physics/order_directions.h"

#include <algorithm>

#include "engine/colour/sampled_spectrum.h"
#include "modules/diffraction/model/grating_equation.h"

namespace rowland::inspector {

namespace {

OrderTrace trace(const diffraction::Grating& grating, int order, const glm::dvec3& s, int step_nm) {
    OrderTrace result{order, {}};
    for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; nm += step_nm) {
        const auto v_g = diffraction::diffracted_cosine(s.x, order, nm, grating.pitch_nm);
        if (v_g && *v_g * *v_g + s.y * s.y < 1.0) result.spots.push_back({static_cast<double>(nm), *v_g, -s.y});
    }
    return result;
}

}  // namespace

std::vector<OrderTrace> order_directions(const diffraction::Grating& grating, const glm::dvec3& s, int step_nm) {
    std::vector<int> orders = grating.orders;
    if (std::find(orders.begin(), orders.end(), 0) == orders.end()) orders.push_back(0);
    std::sort(orders.begin(), orders.end());
    std::vector<OrderTrace> traces;
    for (const int order : orders) {
        OrderTrace found = trace(grating, order, s, step_nm);
        if (!found.spots.empty()) traces.push_back(std::move(found));
    }
    return traces;
}

}  // namespace rowland::inspector
