// Arc coefficients, spikes and their table, the reference beside them; lobes and orders of width: few grooves, narrow
// lobes and pits; gratings whose efficiencies come as tables.
#include <glm/gtc/matrix_access.hpp>

#include "modules/diffraction/bake/arc_moments.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/representations/spikes/spikes.h"
#include "tests/property/generators.h"
#include "tests/unit/modules/diffraction/reference/brute_force.h"

namespace rowland::property {
namespace {

using namespace diffraction;

/// Of one band: √((2l+1)/4π), the most a band's vector of harmonics can measure.
double band_norm(int l) {
    return std::sqrt((2 * l + 1) / (4.0 * std::numbers::pi));
}

std::vector<double> arc_coefficients(const ArcCoefficients& arcs, double a, double v_h, double wavelength_nm) {
    std::vector<double> arc_frame(static_cast<std::size_t>(math::sh_count(arcs.bands())), 0.0);
    std::vector<double> result(arc_frame.size());
    arcs.accumulate(a, v_h, wavelength_nm, 1.0, arc_frame);
    arcs.to_tangent_frame(arc_frame, result);
    return result;
}

/// C gathers directions with a total weight ∫ D_h ds_h ≤ 1, so each band's vector is at most the band's norm, and C_0
/// is that weight times Y_0: not negative. 1e-6: the quadrature of narrow lobes and long pits.
RC_GTEST_PROP(ArcProperty, CoefficientsAreBounded, ()) {
    const GrooveLobe shape = *lobe();
    const ArcCoefficients arcs(*whole(1, 32), shape);
    const double a =
        *rc::gen::oneOf(uniform(-1.0, 1.0), rc::gen::element(-1.0, 1.0, 1.0 - 1e-16, 1.0 - 1e-9, 0.0, 1.5));
    const double v_h = *rc::gen::oneOf(uniform(-1.0, 1.0), rc::gen::element(-1.0, 0.0, 1.0));
    const std::vector<double> c = arc_coefficients(arcs, a, v_h, *wavelength());
    RC_ASSERT(c[0] >= 0.0);
    for (int l = 0; l < arcs.bands(); ++l) {
        double squared = 0.0;
        for (int m = -l; m <= l; ++m) squared += std::pow(c[static_cast<std::size_t>(math::sh_index(l, m))], 2);
        RC_ASSERT(std::sqrt(squared) <= band_norm(l) * (1.0 + 1e-6));
        RC_ASSERT(std::abs(a) < 1.0 || squared == 0.0);
    }
}

/// The flat lobe: r = √(1−a²) moves by at most √(2ε) when a does by ε, a direction on the arc by as much, and Y_l by l
/// times its angle. Twice that: chord and arc.
RC_GTEST_PROP(ArcProperty, FlatCoefficientsAreContinuous, ()) {
    const ArcCoefficients arcs(*whole(1, 16), FlatLobe{});
    const double a = *rc::gen::oneOf(uniform(-1.0, 1.0), rc::gen::element(-1.0, 1.0 - 1e-9, 0.0));
    const double step = *log_uniform(1e-15, 1e-4);
    const std::vector<double> here = arc_coefficients(arcs, a, 0.0, 550.0);
    const std::vector<double> there = arc_coefficients(arcs, a + step, 0.0, 550.0);
    for (int l = 0; l < arcs.bands(); ++l)
        for (int m = -l; m <= l; ++m) {
            const auto i = static_cast<std::size_t>(math::sh_index(l, m));
            RC_ASSERT(std::abs(there[i] - here[i]) <=
                      2.0 * band_norm(l) * (1 + l) * (std::sqrt(2.0 * step) + step) + 1e-13);
        }
}

/// Any view, the rim included.
glm::dvec2 any_view() {
    const glm::dvec3 v = *upper_direction();
    return *whole(0, 4) == 0 ? glm::dvec2(*rc::gen::element(-1.0, 1.0), 0.0) : glm::dvec2(v);
}

SpikeSettings any_settings() {
    SpikeSettings settings;
    settings.bands = *whole(1, 6);
    settings.spikes = *rc::gen::oneOf(whole(1, 8), whole(1, 64));
    settings.illuminant =
        *whole(0, 4) == 0 ? colour::parse_illuminant("wavelength_nm,relative_power\n588,0\n589,1\n590,0\n", "sodium")
                          : colour::illuminant(*rc::gen::elementOf(colour::illuminant_names()));
    return settings;
}

/// Finite at every view, wavelengths ascending within the visible; and the sum over spikes is the whole ∫ c_i q dλ,
/// here by the trapezoid rule: 1e-12 of Σ_m η_m times ∫ q.
RC_GTEST_PROP(SpikeProperty, KeepTheWholeLightAtEveryView, ()) {
    const Grating shape = *baked_grating(13);
    const SpikeSettings settings = any_settings();
    const glm::dvec2 view = any_view();
    const SpikeSet spikes = bake_spikes(shape, view.x, view.y, settings);
    const ViewSpectrum spectrum(shape, settings.bands);
    const std::vector<double> c = spectrum.coefficients(view.x, view.y);
    const auto count = static_cast<std::size_t>(settings.bands * settings.bands);
    RC_ASSERT(spikes.coefficients.size() == count * static_cast<std::size_t>(settings.spikes));
    double before = 380.0;
    for (const double wavelength_nm : spikes.wavelengths_nm) {
        RC_ASSERT(wavelength_nm >= before);
        RC_ASSERT(wavelength_nm <= 780.0);
        before = wavelength_nm;
    }
    const double scale = 1.0 / colour::luminous_power(settings.illuminant);
    for (std::size_t i = 0; i < count; ++i) {
        double integral = 0.0;
        double white = 0.0;
        for (std::size_t j = 0; j < kWavelengths; ++j) {
            const double wavelength_nm = 380.0 + static_cast<double>(j);
            const glm::dvec3 cmf = colour::cie_xyz(wavelength_nm);
            const double q = (j == 0 || j + 1 == kWavelengths ? 0.5 : 1.0) * scale *
                             settings.illuminant.power(wavelength_nm) * (cmf.x + cmf.y + cmf.z);
            integral += c[j * count + i] * q;
            white += q;
        }
        double sum = 0.0;
        for (std::size_t k = 0; k < spikes.wavelengths_nm.size(); ++k) sum += spikes.coefficients[k * count + i];
        RC_ASSERT(std::isfinite(sum));
        RC_ASSERT(std::abs(sum - integral) <= 1e-12 * (1.0 + spectrum.largest_efficiency()) * white);
    }
}

/// Uniform light is sent out by no negative spike.
RC_GTEST_PROP(SpikeProperty, OfUniformLightAreNonNegative, ()) {
    const Grating shape = *baked_grating(13);
    const glm::dvec2 view = any_view();
    const lighting::ShLight uniform_light{1, {*log_uniform(1e-6, 1e6) * glm::dvec3(1.0, 0.5, 0.2)}};
    const glm::dvec3 xyz = evaluate_spikes(bake_spikes(shape, view.x, view.y, any_settings()), uniform_light);
    RC_ASSERT(is_finite_and_not_negative(xyz));
}

/// Half a step of 16 bits over a component's range (unorm), or 2⁻¹² of half the range (half floats in [−1, 1]); 1e-6
/// for scale and bias in single precision.
RC_GTEST_PROP(SpikeTableProperty, StorageErrorIsHalfAStep, ()) {
    const Grating shape = *baked_grating(8);
    SpikeTableSettings settings;
    settings.spikes = any_settings();
    settings.spikes.bands = std::min(settings.spikes.bands, 3);
    settings.spikes.spikes = std::min(settings.spikes.spikes, 3);
    settings.grid = {.columns = 4, .rows = 3};
    settings.storage = *rc::gen::element(Storage::Unorm16, Storage::Half);
    const SpikeTable table = bake(shape, settings);
    const auto count = static_cast<std::size_t>(settings.spikes.bands * settings.spikes.bands);
    const double theta = 0.25 * std::numbers::pi * *whole(0, 2);
    const double phi = 0.5 * std::numbers::pi * *whole(0, 3);
    const glm::dvec3 v(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                       std::max(std::cos(theta), 1e-12));
    const SpikeSet exact =
        bake_spikes(shape, std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), settings.spikes);
    const SpikeSet stored = sample(table, v.x, v.y, v.z);
    for (std::size_t k = 0; k < exact.wavelengths_nm.size(); ++k)
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t layer = k * static_cast<std::size_t>(table.layers_per_spike()) + i / 4;
            const auto c = static_cast<int>(i % 4);
            const auto scale = static_cast<double>(table.scale[layer][c]);
            const double step = settings.storage == Storage::Half ? scale / 4096.0 : 0.5 * scale / 65535.0;
            const double rounding = 1e-6 * (scale + std::abs(static_cast<double>(table.bias[layer][c])));
            // sample() finds the node to 1e-15 of a turn, and interpolates by as much.
            const double found = stored.coefficients[k * count + i];
            RC_ASSERT(std::isfinite(found));
            RC_ASSERT(std::abs(found - exact.coefficients[k * count + i]) <= step + rounding + 1e-12);
        }
}

/// XYZ of a frame by the harmonics of its light at every nanometre; of a sheet, of the light behind it.
glm::dvec3 by_spectrum(const Grating& shape, const lighting::ShLight& light, const ShadingPoint& frame) {
    const colour::LightSpectra spectra;
    const ShadingPoint shaded = shape.transmission ? lit_from_behind(frame) : frame;
    const glm::dmat3 tangent = world_to_tangent(shaded);
    const glm::dvec3 view = tangent * glm::normalize(shaded.view);
    std::vector<glm::dvec3> turned(light.coefficients.size());
    math::ShRotation(tangent, light.bands)
        .apply(std::span<const glm::dvec3>(light.coefficients), std::span<glm::dvec3>(turned));
    const std::vector<double> c = ViewSpectrum(shape, light.bands).coefficients(view.x, view.y);
    glm::dvec3 xyz(0.0);
    for (std::size_t j = 0; j < kWavelengths; ++j) {
        glm::dvec3 rgb(0.0);
        for (std::size_t i = 0; i < turned.size(); ++i) rgb += c[j * turned.size() + i] * turned[i];
        const double wavelength_nm = 380.0 + static_cast<double>(j);
        xyz += (j == 0 || j + 1 == kWavelengths ? 0.5 : 1.0) * glm::dot(spectra(wavelength_nm), rgb) *
               colour::cie_xyz(wavelength_nm);
    }
    return transmittance(shape.cover, view.z) * xyz;
}

/// The grating as it is where the sheet reflects nothing, so that one side is all.
Grating one_side(Grating shape) {
    if (shape.transmission) shape.transmission->reflectance = 0.0;
    return shape;
}

/// Arcs integrated one by one against harmonics in closed form, both by the trapezoid rule at 1 nm: 1e-7 of what the
/// light could give at most, the quadrature of lobes (measured 1e-9 for most).
RC_GTEST_PROP(ReferenceProperty, EqualsTheClosedFormUnderBandlimitedLight, ()) {
    Grating shape = one_side(*grating(kManyGrooves));
    RC_PRE(shape.orders.size() <= 8U);
    std::erase(shape.orders, 0);
    if (lobe_extent(shape.lobe).feature_size < 0.02) shape.lobe = FlatLobe{};  // slow in the reference
    const lighting::ShLight light = *sh_light(6);
    const glm::dvec3 v = *upper_direction();
    const ShadingPoint frame{.view = v, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}};
    const colour::LightSpectra spectra;
    const glm::dvec3 found = reference_radiance(shape, light, spectra, std::span(&frame, 1)).front();
    RC_ASSERT(is_finite(found));
    RC_ASSERT(largest(found - by_spectrum(shape, light, frame)) <= 1e-7 * total(light));
}

/// Orders end at the horizon, where the reference and the harmonics divide a nanometre differently, at most at one
/// each: 1e-2 of a nanometre's light.
RC_GTEST_PROP(ReferenceProperty, OfALatticeEqualsTheClosedForm, ()) {
    const Grating shape = one_side(*lattice());
    const lighting::ShLight light = *sh_light(6);
    const ShadingPoint frame{.view = *upper_direction(), .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}};
    const glm::dvec3 found = reference_radiance(shape, light, colour::LightSpectra(), std::span(&frame, 1)).front();
    RC_ASSERT(is_finite(found));
    RC_ASSERT(largest(found - by_spectrum(shape, light, frame)) <= 1e-4 * total(light));
}

RC_GTEST_PROP(ReferenceProperty, NoLightAndNoOrderAreBlack, ()) {
    Grating shape = *grating();
    shape.pitch_nm = *uniform(50.0, shape.grooves < kManyGrooves ? 300.0 : 3000.0);
    shape.profile = SlitProfile{shape.pitch_nm * *uniform(0.01, 1.0)};
    if (shape.grooves < kManyGrooves) shape.lobe = FlatLobe{};
    RC_PRE(lobe_extent(shape.lobe).feature_size > 0.01);
    const glm::dvec3 v = *upper_direction();
    const ShadingPoint frame{.view = v, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}};
    const colour::LightSpectra spectra;
    const lighting::ShLight none{2, std::vector<glm::dvec3>(4, glm::dvec3(0.0))};
    RC_ASSERT(reference_radiance(shape, none, spectra, std::span(&frame, 1)).front() == glm::dvec3(0.0));
    shape.pitch_nm = *uniform(50.0, 189.9);
    shape.profile = SlitProfile{0.5 * shape.pitch_nm};
    std::erase(shape.orders, 0);
    const lighting::ShLight white{1, {glm::dvec3(1e6)}};
    RC_ASSERT(reference_radiance(shape, white, spectra, std::span(&frame, 1)).front() == glm::dvec3(0.0));
}

RC_GTEST_PROP(BruteForceProperty, IsFiniteForEveryGratingAndView, ()) {
    const Grating shape = *grating(kManyGrooves);
    RC_PRE(shape.orders.size() <= 13U);
    const int bands = *whole(1, 5);
    const std::vector<glm::dmat3> c =
        brute_force_coefficients(shape, colour::LightSpectra(), *upper_direction(),
                                 {.bands = bands, .samples = static_cast<std::size_t>(*whole(1, 500)), .seed = 3});
    RC_ASSERT(c.size() == static_cast<std::size_t>(bands * bands));
    for (const glm::dmat3& one : c) RC_ASSERT(is_finite(one));
}

/// Y = 1 from everywhere.
lighting::ShLight white_light() {
    return {1, {glm::dvec3(2.0 * std::sqrt(std::numbers::pi))}};
}

glm::dvec3 under_white_light(const Grating& shape, const glm::dvec3& view) {
    const ShadingPoint frame{.view = view, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}};
    return reference_radiance(shape, white_light(), colour::LightSpectra(), std::span(&frame, 1)).front();
}

std::vector<int> with_zero_order(std::vector<int> orders) {
    orders.insert(std::lower_bound(orders.begin(), orders.end(), 0), 0);
    return orders;
}

/// The slope of a Gaussian is at most its peak/(σ√e). 1e-13: rounding of the exponent.
RC_GTEST_PROP(GaussianLobeProperty, IsContinuousInDirection, ()) {
    const double sigma = *log_uniform(1e-4, 10.0);
    const LobeDensity density(GaussianLobe{sigma}, 550.0);
    const double sum_h = *rc::gen::oneOf(uniform(-2.0, 2.0), uniform(-3.0 * sigma, 3.0 * sigma));
    const double step = *log_uniform(1e-16, 1e-3);
    const double slope = density(0.0) / sigma / std::sqrt(std::numbers::e);
    RC_ASSERT(std::abs(density(sum_h + step) - density(sum_h)) <= slope * step + 1e-13 * density(0.0));
}

/// σ ∂D/∂σ is D (z² − 1) plus D times a factor of 0 to 1 from the norm: at most 2 D(0). Any bend where the lobe is
/// taken for flat, or the norm for 1, would show as a jump.
RC_GTEST_PROP(GaussianLobeProperty, IsContinuousInItsWidth, ()) {
    const double sigma = *rc::gen::oneOf(log_uniform(1e-4, 10.0), log_uniform(0.05, 1000.0));
    const double sum_h = *rc::gen::oneOf(uniform(-2.0, 2.0), uniform(-3.0 * sigma, 3.0 * sigma));
    const double step = *log_uniform(1e-15, 1e-3);
    const LobeDensity here(GaussianLobe{sigma}, 550.0);
    const LobeDensity there(GaussianLobe{sigma * (1.0 + step)}, 550.0);
    RC_ASSERT(std::abs(there(sum_h) - here(sum_h)) <= (2.0 * step * (1.0 + step) + 1e-13) * here(0.0));
}

/// The lobe's shift by ε changes ∫ D Y ds_h by at most ε times D's variation, 2 D(0), times |Y|. 1e-6: the quadrature's
/// own error, as in ArcProperty.
RC_GTEST_PROP(GaussianLobeProperty, ArcCoefficientsAreContinuousInTheView, ()) {
    const GaussianLobe shape{*log_uniform(1e-3, 3.0)};
    const ArcCoefficients arcs(*whole(1, 8), shape);
    const double a = *uniform(-1.0, 1.0);
    const double v_h = *uniform(-1.0, 1.0);
    const double step = *log_uniform(1e-14, 1e-4);
    const double variation = 2.0 * lobe_density(shape, 0.0, 550.0);
    const std::vector<double> here = arc_coefficients(arcs, a, v_h, 550.0);
    const std::vector<double> there = arc_coefficients(arcs, a, v_h + step, 550.0);
    for (int l = 0; l < arcs.bands(); ++l)
        for (int m = -l; m <= l; ++m) {
            const auto i = static_cast<std::size_t>(math::sh_index(l, m));
            RC_ASSERT(std::abs(there[i] - here[i]) <= band_norm(l) * (variation * step + 1e-6));
        }
}

/// Pits of any length under uniform light, from any side, with all orders: never more than fell in. 1e-6: quadrature.
RC_GTEST_PROP(PitsProperty, ReturnNoMoreLightThanFallsIn, ()) {
    Grating shape;
    shape.pitch_nm = *log_uniform(300.0, 2000.0);
    shape.profile = *profile(shape.pitch_nm);
    shape.lobe = PitsLobe{*log_uniform(100.0, 5000.0), *rc::gen::oneOf(uniform(0.0, 1.0), rc::gen::element(0.0, 1.0))};
    shape.orders = *rc::gen::element(with_zero_order(all_orders(shape.pitch_nm)), std::vector<int>{-1, 0, 1});
    RC_PRE(shape.orders.size() <= 7U);
    const glm::dvec3 xyz = under_white_light(shape, *upper_direction());
    RC_ASSERT(is_finite_and_not_negative(xyz));
    RC_ASSERT(xyz.y <= 1.0 + 1e-6);
}

/// A few grooves with every order: what N grooves send out is the power spectrum of a phase, whose integral is 1
/// (Parseval), of which the flat lobe and the horizon leave less. Work grows with grooves × pitch.
Grating few_grooves(double finest_nm, double coarsest_nm, int most_grooves) {
    Grating shape;
    shape.pitch_nm = *log_uniform(finest_nm, coarsest_nm);
    shape.grooves = *whole(1, most_grooves);
    const double depth_nm = *rc::gen::oneOf(uniform(0.0, 400.0), log_uniform(1e-3, 1e3));
    if (*whole(0, 1) == 0)
        shape.profile = LamellarProfile{*rc::gen::oneOf(uniform(0.0, 1.0), rc::gen::element(1e-9, 0.5)), depth_nm};
    else
        shape.profile = SinusoidalProfile{depth_nm};
    shape.orders = with_zero_order(all_orders(shape.pitch_nm));
    return shape;
}

/// 1e-3: steps of the reference's sum over the orders' width.
RC_GTEST_PROP(FewGroovesProperty, ReturnNoMoreLightThanFallsIn, ()) {
    if (*whole(0, 3) != 0) return;  // a case takes .4 s: every fourth will do
    const glm::dvec3 xyz = under_white_light(few_grooves(300.0, 500.0, 8), *upper_direction());
    RC_ASSERT(is_finite_and_not_negative(xyz));
    RC_ASSERT(xyz.y <= 1.0 + 1e-3);
}

/// f, not only its integral, is finite, non-negative and reciprocal; and so is what is baked of it.
RC_GTEST_PROP(FewGroovesProperty, BrdfIsFiniteNonNegativeAndReciprocal, ()) {
    const Grating shape = few_grooves(300.0, 2000.0, 49);
    const glm::dvec3 s = *upper_direction();
    const glm::dvec3 v = *rc::gen::oneOf(upper_direction(), rc::gen::just(glm::dvec3(-s.x, -s.y, s.z)));
    const double wavelength_nm = *wavelength();
    const double f = brdf_energy(shape, s, v, wavelength_nm);
    RC_ASSERT(std::isfinite(f));
    RC_ASSERT(f >= 0.0);
    RC_ASSERT(f == brdf_energy(shape, v, s, wavelength_nm));
}

RC_GTEST_PROP(FewGroovesProperty, KernelIsFiniteAndNonNegative, ()) {
    if (*whole(0, 3) != 0) return;  // a case takes .2 s: every fourth will do
    const Grating shape = few_grooves(150.0, 250.0, 4);
    const ColourKernel kernel(shape, colour::LightSpectra());
    for (int i = 0; i < 20; ++i) {
        const glm::dmat3 k = kernel(*uniform(-2.0 * shape.pitch_nm, 2.0 * shape.pitch_nm));
        for (int c = 0; c < 3; ++c) RC_ASSERT(is_finite_and_not_negative(k[c]));
    }
}

/// Efficiencies at one wavelength that sum to 1 or less; sometimes an order is cut off.
std::vector<double> any_row(std::size_t orders) {
    std::vector<double> row;
    for (std::size_t i = 0; i < orders; ++i) row.push_back(*whole(0, 4) == 0 ? 0.0 : *uniform(0.0, 1.0));
    double sum = 0.0;
    for (const double efficiency : row) sum += efficiency;
    const double all = *rc::gen::oneOf(uniform(0.0, 1.0), rc::gen::element(1.0));
    for (double& efficiency : row) efficiency = sum > 0.0 ? efficiency * all / sum : 0.0;
    return row;
}

EfficiencySlice any_slice(double incidence_deg, std::size_t orders) {
    EfficiencySlice slice{.incidence_deg = incidence_deg, .wavelengths_nm = {}, .efficiencies = {}};
    double wavelength_nm = *uniform(300.0, 500.0);
    for (int rows = *whole(1, 6); rows > 0; --rows) {
        slice.wavelengths_nm.push_back(wavelength_nm);
        const std::vector<double> row = any_row(orders);
        slice.efficiencies.insert(slice.efficiencies.end(), row.begin(), row.end());
        wavelength_nm += *log_uniform(0.1, 200.0);
    }
    return slice;
}

EfficiencyTable any_table() {
    EfficiencyTable table;
    for (int order = -4; order <= 4; ++order)
        if (*whole(0, 1) == 0) table.orders.push_back(order);
    if (table.orders.empty()) table.orders = {1};
    double incidence_deg = *uniform(-80.0, 0.0);
    for (int slices = *whole(1, 3); slices > 0; --slices) {
        table.slices.push_back(any_slice(incidence_deg, table.orders.size()));
        incidence_deg += *uniform(1.0, 40.0);
    }
    return table;
}

/// Between rows, between slices and where an order is held up to its cut-off: fractions of 1. 1e-14: rounding of the
/// sum.
RC_GTEST_PROP(TableProperty, OrdersShareThePower, ()) {
    const EfficiencyTable table = any_table();
    const double pitch_nm = *pitch();
    const double wavelength_nm = *rc::gen::oneOf(wavelength(), uniform(200.0, 1500.0));
    const double s_g = *rc::gen::oneOf(uniform(-1.0, 1.0), rc::gen::element(-1.0, 0.0, 1.0));
    double sum = 0.0;
    for (int order = -5; order <= 5; ++order) {
        const double efficiency = table_efficiency(table, pitch_nm, order, wavelength_nm, s_g);
        RC_ASSERT(std::isfinite(efficiency));
        RC_ASSERT(efficiency >= 0.0);
        sum += efficiency;
    }
    RC_ASSERT(sum <= 1.0 + 1e-14);
}

/// Uniform white light comes back as no more than itself from any side. Not so from a table that varies with the
/// incidence: a view gathers orders from several incidences, and nothing makes a table reciprocal; what such a one
/// sends out from each incidence is held above. 1e-6: the reference's quadrature of a lobe.
RC_GTEST_PROP(TableProperty, ReturnsNoMoreLightThanFallsIn, ()) {
    EfficiencyTable table = any_table();
    table.slices.resize(1);
    Grating shape;
    shape.pitch_nm = *rc::gen::oneOf(log_uniform(150.0, 5000.0), log_uniform(400.0, 2000.0));
    shape.profile = table;
    shape.orders = table.orders;
    if (*whole(0, 1) == 0) shape.lobe = GaussianLobe{*log_uniform(0.05, 3.0)};
    const glm::dvec3 xyz = under_white_light(shape, *upper_direction());
    RC_ASSERT(is_finite_and_not_negative(xyz));
    RC_ASSERT(xyz.y <= 1.0 + 1e-6);
}

}  // namespace
}  // namespace rowland::property
