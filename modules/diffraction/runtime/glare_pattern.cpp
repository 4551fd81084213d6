#include "modules/diffraction/runtime/glare_pattern.h"

#include <glm/matrix.hpp>

#include "engine/colour/colour_space.h"
#include "modules/diffraction/bake/diffraction_pattern.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

namespace {

/// Distance between points of an order, in direction cosines: below a cell of most pictures.
constexpr double kPointStep = 0.001;

/// ∫ η₀ cmf Eᵀ dλ
glm::dmat3 zero_order_xyz(const Grating& grating, const colour::LightSpectra& spectra) {
    glm::dmat3 sum(0.0);
    for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; ++nm) {
        const double step_nm = nm == colour::kVisibleMin || nm == colour::kVisibleMax ? 0.5 : 1.0;
        sum += step_nm * zero_order_efficiency(grating, nm) * observed_spectra(spectra, nm);
    }
    return sum;
}

}  // namespace

post::GlarePattern glare_pattern(const Grating& grating, const glm::dmat3& xyz_to_working) {
    const colour::LightSpectra spectra;
    const glm::dmat3 to_rec709 = glm::inverse(xyz_to_working * colour::rec709_to_xyz());
    post::GlarePattern pattern{.straight = glm::mat3(xyz_to_working * zero_order_xyz(grating, spectra) * to_rec709),
                               .points = {}};
    // Light from u = s_p + v_p, where v_p is opposite to the direction in which it is seen: that is s_p − u.
    for (const DiffractionPattern::Node& node : diffraction_pattern(grating, spectra, kPointStep).nodes)
        if (node.u != glm::vec2(0.0F))
            pattern.points.push_back({-node.u, glm::mat3(xyz_to_working * glm::dmat3(node.weight) * to_rec709)});
    return pattern;
}

}  // namespace rowland::diffraction
