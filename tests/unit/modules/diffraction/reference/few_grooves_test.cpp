// Fewer than fifty grooves: the reference against the pointwise BRDF, and how it meets N → ∞.
#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "engine/math/quadrature.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/support/files.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

namespace rowland::diffraction {
namespace {

using test::relative_rms;

const std::vector<ShadingPoint> kFewGrooveFrames = {
    {.view = {0.3, 0.1, 0.9}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}},
    {.view = {-0.7, 0.4, 0.3}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}}};

Grating compact_disc(double grooves) {
    return {.pitch_nm = 1600.0, .grooves = grooves, .profile = SlitProfile{800.0}, .orders = {-1, 1, 2}};
}

/// The slow reference: ∫∫ f_E L s_n dω dλ with the pointwise BRDF, over s_g and s_h (s_n dω = ds_g ds_h), by a midpoint
/// rule in s_g whose step of 2 nm in x resolves the 19 nm of N = 20, and Gauss–Legendre along the arc.
glm::dvec3 brute_force(const Grating& grating, const lighting::ShLight& light, const colour::LightSpectra& spectra,
                       const glm::dvec3& v) {
    const math::QuadratureRule arc = math::gauss_legendre(24, 0.0, std::numbers::pi);
    std::vector<double> basis(light.coefficients.size());
    glm::dvec3 sum(0.0);
    const int nodes = 1600;
    for (int i = 0; i < nodes; ++i) {
        const double s_g = (i + 0.5) * 2.0 / nodes - 1.0;
        const double r = std::sqrt(1.0 - s_g * s_g);
        for (std::size_t j = 0; j < arc.nodes.size(); ++j) {
            const glm::dvec3 s(s_g, r * std::cos(arc.nodes[j]), r * std::sin(arc.nodes[j]));
            math::evaluate_sh(s, light.bands, basis);
            glm::dvec3 radiance(0.0);
            for (std::size_t k = 0; k < basis.size(); ++k) radiance += basis[k] * light.coefficients[k];
            const double area = 2.0 / nodes * arc.weights[j] * s.z;
            for (int wavelength_nm = 380; wavelength_nm <= 780; wavelength_nm += 2) {
                const double step_nm = wavelength_nm == 380 || wavelength_nm == 780 ? 1.0 : 2.0;
                sum += step_nm * area * brdf_energy(grating, s, v, wavelength_nm) *
                       glm::dot(spectra(wavelength_nm), radiance) * colour::cie_xyz(wavelength_nm);
            }
        }
    }
    return sum;
}

/// Tolerance: 2 nm against 1 nm wavelengths, and steps at the borders of the listed orders' periods, which a single
/// groove's flat spectrum takes at full height and N grooves at 1/N² of it.
TEST(FewGrooves, HaveTheirTrueWidth) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    for (const double grooves : {1.0, 5.0, 20.0}) {
        const Grating grating = compact_disc(grooves);
        const auto found = reference_radiance(grating, light, colour::LightSpectra(), kFewGrooveFrames);
        for (std::size_t i = 0; i < kFewGrooveFrames.size(); ++i) {
            const glm::dvec3 v = glm::normalize(kFewGrooveFrames[i].view);
            const double error = relative_rms({found[i]}, {brute_force(grating, light, colour::LightSpectra(), v)});
            RecordProperty(fmt::format("N{}_view{}", grooves, i), fmt::format("{:.3g}", error));
            EXPECT_LT(error, grooves == 1.0 ? 3e-3 : 1e-3) << grooves << " grooves, view " << i;
        }
    }
}

/// At fixed light the distance to N → ∞ falls with every doubling, and at 49 the switch at kManyGrooves is a step of a
/// few per cent at most: what sidelobes carry into other light.
TEST(FewGrooves, MeetTheLimitOfManyAsTheirNumberGrows) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const auto many = reference_radiance(compact_disc(1500.0), light, colour::LightSpectra(), kFewGrooveFrames);
    double last = 10.0;
    for (const double grooves : {2.0, 4.0, 8.0, 16.0, 32.0, 49.0}) {
        const auto few = reference_radiance(compact_disc(grooves), light, colour::LightSpectra(), kFewGrooveFrames);
        const double error = relative_rms(few, many);
        RecordProperty(fmt::format("N{}", grooves), fmt::format("{:.3g}", error));
        EXPECT_LT(error, last) << grooves;
        EXPECT_GT(error, 1e-6) << grooves;
        last = error;
    }
    EXPECT_LT(last, 0.05);
}

TEST(FewGrooves, FiftyAreTreatedAsInfinitelyMany) {
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    EXPECT_EQ(reference_radiance(compact_disc(50.0), light, colour::LightSpectra(), kFewGrooveFrames),
              reference_radiance(compact_disc(1e6), light, colour::LightSpectra(), kFewGrooveFrames));
}

}  // namespace
}  // namespace rowland::diffraction
