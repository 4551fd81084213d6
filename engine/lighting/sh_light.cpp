#include "engine/lighting/sh_light.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/math/sh_basis.h"

namespace rowland::lighting {

ShLight limit_bands(const ShLight& light, int bands, math::SphericalWindow window) {
    ROWLAND_CHECK_OP(bands, >=, 1);
    const int present = std::min(bands, light.bands);
    ShLight limited{.bands = bands, .coefficients = {}};
    for (int l = 0; l < present; ++l) {
        const double factor = math::window_factor(window, l, present);
        for (int m = -l; m <= l; ++m)
            limited.coefficients.push_back(factor * light.coefficients[static_cast<std::size_t>(math::sh_index(l, m))]);
    }
    limited.coefficients.resize(static_cast<std::size_t>(math::sh_count(bands)), glm::dvec3(0.0));
    return limited;
}

}  // namespace rowland::lighting
