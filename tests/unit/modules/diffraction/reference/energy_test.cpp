// What a grating sends on of what falls in (PHYSICS §3): under uniform white light, and never more than 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "engine/colour/spectrum.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::diffraction {
namespace {

constexpr double kPitch_nm = 1600.0;

lighting::ProbeImage white_probe() {
    image::Image image{.width = 256, .height = 128, .texels = std::vector(std::size_t{256} * 128, glm::vec3(1.0F))};
    return {std::move(image), lighting::Mapping::Equirectangular, "white"};
}

lighting::ShLight white_light() {
    return {.bands = 1, .coefficients = {glm::dvec3(2.0 * std::sqrt(std::numbers::pi))}};
}

std::vector<Profile> profiles() {
    const EfficiencyTable table{
        .orders = {-1, 0, 1, 2},
        .slices = {{.wavelengths_nm = {380.0, 780.0}, .efficiencies = {0.2, 0.3, 0.3, 0.2, 0.1, 0.5, 0.3, 0.1}}}};
    return {SlitProfile{800.0},       SlitProfile{kPitch_nm}, LamellarProfile{0.35, 130.0},
            SinusoidalProfile{150.0}, BlazedProfile{260.0},   table};
}

/// A material with every order that propagates, and the mirror.
Grating complete(const Profile& profile, const GrooveLobe& lobe) {
    Grating grating{.pitch_nm = kPitch_nm, .profile = profile, .orders = all_orders(kPitch_nm), .lobe = lobe};
    grating.orders.insert(std::lower_bound(grating.orders.begin(), grating.orders.end(), 0), 0);
    return grating;
}

/// Luminance of white light after Σ_m η_m(λ), over the orders that propagate at normal incidence.
double luminance_at_normal_incidence(const Grating& grating) {
    const colour::LightSpectra spectra;
    double sum = 0.0;
    for (int wavelength_nm = 380; wavelength_nm <= 780; ++wavelength_nm) {
        const glm::dvec3 e = spectra(wavelength_nm);
        const double step_nm = wavelength_nm == 380 || wavelength_nm == 780 ? 0.5 : 1.0;
        for (const int order : grating.orders) {
            const double v_g = order * wavelength_nm / grating.pitch_nm;
            if (std::abs(v_g) < 1.0)
                sum += step_nm * order_efficiency(grating, order, wavelength_nm) * (e.r + e.g + e.b) *
                       colour::cie_xyz(wavelength_nm).y;
        }
    }
    return sum;
}

const ShadingPoint kNormalIncidence{.view = {0, 0, 1}, .normal = {0, 0, 1}, .grating = {1, 0, 0}};

/// A narrow lobe loses nothing away from cut-off. Orders to ±2: 2·780/1600 leaves a half circle of radius 0.22, wider
/// than the lobe's half width. To 1e-3.
TEST(Energy, NarrowLobeUnderUniformLightIsTheSumOfOrders) {
    const auto probe = white_probe();
    for (const Profile& profile : profiles()) {
        Grating grating = complete(profile, GaussianLobe{0.02});
        grating.orders = {-2, -1, 0, 1, 2};
        const auto found = reference_radiance(grating, probe, colour::LightSpectra(), std::span(&kNormalIncidence, 1));
        const double expected = luminance_at_normal_incidence(grating);
        EXPECT_NEAR(found[0].y, expected, 1e-3 * expected) << profile.index();
    }
}

/// Views by polar angle and azimuth from g, in degrees.
std::vector<ShadingPoint> tilted(const std::vector<double>& polar_deg, const std::vector<double>& azimuths_deg) {
    std::vector<ShadingPoint> frames;
    for (const double theta_deg : polar_deg)
        for (const double phi_deg : azimuths_deg) {
            const double theta = theta_deg * std::numbers::pi / 180.0;
            const double phi = phi_deg * std::numbers::pi / 180.0;
            frames.push_back(
                {.view = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)},
                 .normal = {0, 0, 1},
                 .grating = {1, 0, 0}});
        }
    return frames;
}

/// Every order's arc carries η_m ∫ D_h ds_h over its half circle, at most η_m, and Σ η_m ≤ 1: at any angle, flat lobe
/// or not. Views from the normal to grazing, across and along the grooves.
TEST(Energy, NothingComesOutThatDidNotFallInAtAnyAngle) {
    const std::vector<ShadingPoint> frames = tilted({55.0, 0.0, 15.0, 35.0, 75.0, 89.0}, {0.0, 40.0, 90.0, 180.0});
    for (const GrooveLobe& lobe :
         {GrooveLobe{FlatLobe{}}, GrooveLobe{GaussianLobe{0.02}}, GrooveLobe{GaussianLobe{0.5}},
          GrooveLobe{PitsLobe{850.0, 0.3}}, GrooveLobe{PitSequenceLobe{{1200.0, 2700.0}, 0.5, 0.05}}}) {
        double largest = 0.0;
        // Pits take a thousand nodes per arc, so only the first points are checked.
        const auto some = std::span(frames).first(depends_on_wavelength(lobe) ? 3 : frames.size());
        for (const Profile& profile : profiles())
            for (const glm::dvec3& xyz :
                 reference_radiance(complete(profile, lobe), white_light(), colour::LightSpectra(), some)) {
                EXPECT_LT(xyz.y, 1.0 + 1e-6) << lobe.index() << " " << profile.index();
                largest = std::max(largest, xyz.y);
            }
        EXPECT_GT(largest, 0.75) << lobe.index();
    }
}

/// T(v_n) ∫ T(s_n) … is at most T(v_n), and the gloss is 1 − T(v_n): together at most 1, at any angle.
TEST(Energy, UnderACoverGlossAndOrdersAreNoMoreThanWhatFallsIn) {
    const std::vector<ShadingPoint> frames = tilted({0.0, 35.0, 70.0, 85.0, 89.0}, {0.0, 40.0, 90.0});
    for (const GrooveLobe& lobe : {GrooveLobe{FlatLobe{}}, GrooveLobe{GaussianLobe{0.02}}}) {
        double largest = 0.0;
        for (const Profile& profile : profiles()) {
            Grating grating = complete(profile, lobe);
            grating.cover = Cover{};
            const auto xyz = reference_radiance(grating, white_light(), colour::LightSpectra(), frames);
            for (std::size_t i = 0; i < frames.size(); ++i) {
                const double gloss = 1.0 - transmittance(grating.cover->ior, frames[i].view.z);
                EXPECT_LT(xyz[i].y + gloss, 1.0 + 1e-6) << lobe.index() << " " << profile.index();
                largest = std::max(largest, xyz[i].y + gloss);
            }
        }
        EXPECT_GT(largest, 0.75) << lobe.index();
    }
}

}  // namespace
}  // namespace rowland::diffraction
