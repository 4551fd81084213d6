// The grating's equation, efficiencies, lobes and BRDFs; the colour kernel and its table.

#include "modules/diffraction/model/colour_kernel.h"
#include "tests/property/generators.h"

namespace rowland::property {
namespace {

using namespace diffraction;

rc::Gen<double> fejer_delta() {
    return rc::gen::oneOf(uniform(-0.5, 0.5), uniform(-1000.0, 1000.0), log_uniform(1e-16, 0.5),
                          rc::gen::element(0.0, 0.5, -0.5, 1.0, 1e-300));
}

/// A squared mean of unit phasors: in [0, 1]. 4e-16: rounding of a quotient and its square.
RC_GTEST_PROP(FejerProperty, LiesBetweenZeroAndOne, ()) {
    const double ratio = fejer(*grooves(), *fejer_delta());
    RC_ASSERT(ratio >= 0.0);
    RC_ASSERT(ratio <= 1.0 + 4e-16);
}

/// PHYSICS §9: 1e-5 absolute in float, for the same δ.
RC_GTEST_PROP(FejerProperty, FloatIsTheDouble, ()) {
    const auto n = static_cast<float>(*grooves());
    const auto delta = static_cast<float>(*fejer_delta());
    const double exact = fejer(static_cast<double>(n), static_cast<double>(delta));
    RC_ASSERT(std::abs(static_cast<double>(fejer(n, delta)) - exact) <= 1e-5);
}

/// F_N is a trigonometric polynomial of degree N−1 between 0 and 1: its slope is at most π(N−1) (Bernstein). δ is kept
/// within half a period, where it loses no digits; 1e-12 for the values' own error.
RC_GTEST_PROP(FejerProperty, IsContinuous, ()) {
    const double n = *grooves();
    const double delta = *uniform(-0.5, 0.5);
    const double step = *log_uniform(1e-14, 1e-3);
    RC_ASSERT(std::abs(fejer(n, delta + step) - fejer(n, delta)) <= std::numbers::pi * n * step + 1e-12);
}

RC_GTEST_PROP(PeakProperty, SolvesTheGratingEquation, ()) {
    const double pitch_nm = *pitch();
    const std::vector<int> listed = *orders(pitch_nm);
    const double u = *rc::gen::oneOf(uniform(-2.0, 2.0), rc::gen::element(0.0, -2.0, 2.0, 1e-300));
    for (const Peak& peak : visible_peaks(u, pitch_nm, listed)) {
        RC_ASSERT(u != 0.0);
        RC_ASSERT(peak.order != 0);
        RC_ASSERT(peak.wavelength_nm >= 380.0);
        RC_ASSERT(peak.wavelength_nm <= 780.0);
        // Two roundings.
        RC_ASSERT(std::abs(peak.order * peak.wavelength_nm - pitch_nm * u) <= 5e-16 * std::abs(pitch_nm * u));
        RC_ASSERT(propagates(peak.order, peak.wavelength_nm, pitch_nm) || std::abs(u) >= 2.0 * (1.0 - 1e-15));
    }
}

/// η_m is a fraction of the incident power, and so is their sum: Σ η_m ≤ 1. 1e-10: the Bessel function's error over
/// some hundred orders.
RC_GTEST_PROP(EfficiencyProperty, OrdersShareThePower, ()) {
    const double pitch_nm = *pitch();
    const Profile shape = *profile(pitch_nm);
    const double wavelength_nm = *wavelength();
    double sum = 0.0;
    for (int order = -300; order <= 300; ++order) {
        const double efficiency = profile_efficiency(shape, pitch_nm, order, wavelength_nm);
        RC_ASSERT(efficiency >= 0.0);
        RC_ASSERT(efficiency <= 1.0 + 1e-12);
        sum += efficiency;
    }
    RC_ASSERT(sum <= 1.0 + 1e-10);
}

/// The same of a lattice, by every nanometre's reflectance, and of both sides of a sheet (PHYSICS (12.2)).
RC_GTEST_PROP(EfficiencyProperty, OrdersOfALatticeShareThePower, ()) {
    const Grating shape = *lattice();
    const double wavelength_nm = *wavelength();
    double sum = 0.0;
    const auto add = [&](const Grating& side) {
        for (const double efficiency : lattice_order_efficiencies(side, wavelength_nm)) {
            RC_ASSERT(efficiency >= 0.0);
            sum += efficiency;
        }
    };
    add(shape);
    if (const auto side = reflected_side(shape)) add(*side);
    RC_ASSERT(sum <= 1.0 + 1e-10);
}

/// At whole orders the groove's own spectrum is η_m. 1e-10: Σ_k J_k sinc of the sinusoidal profile, its worst.
RC_GTEST_PROP(EfficiencyProperty, SpectrumMeetsItAtWholeOrders, ()) {
    const double pitch_nm = *pitch();
    const Profile shape = *profile(pitch_nm);
    const double wavelength_nm = *wavelength();
    const int order = *whole(-8, 8);
    const double spectrum = groove_spectrum(shape, pitch_nm, order, wavelength_nm);
    RC_ASSERT(std::abs(spectrum - profile_efficiency(shape, pitch_nm, order, wavelength_nm)) <= 1e-10);
}

RC_GTEST_PROP(LobeProperty, IsFiniteNonNegativeAndEven, ()) {
    const GrooveLobe shape = *lobe();
    const double wavelength_nm = *wavelength();
    const double sum_h = *rc::gen::oneOf(uniform(-2.0, 2.0), log_uniform(1e-12, 2.0), rc::gen::element(0.0));
    const double density = lobe_density(shape, sum_h, wavelength_nm);
    RC_ASSERT(std::isfinite(density));
    RC_ASSERT(density >= 0.0);
    RC_ASSERT(density == lobe_density(shape, -sum_h, wavelength_nm));
}

/// ∫ D_h over directions is at most 1 whatever the view: s_h spans at most 2. The midpoint rule with 16 nodes a feature
/// is exact to 1e-9 for a Gaussian, whose window may end within it: 1e-2 of a node's weight; pits' sinc² has 1e-4.
RC_GTEST_PROP(LobeProperty, NeverAddsPower, ()) {
    const GrooveLobe shape =
        *rc::gen::suchThat(lobe(), [](const GrooveLobe& l) { return lobe_extent(l).feature_size > 1e-3; });
    const double wavelength_nm = *wavelength();
    const double v_h = *uniform(-1.0, 1.0);
    const LobeDensity density(shape, wavelength_nm);
    const int nodes = static_cast<int>(32.0 / lobe_extent(shape).feature_size) + 32;
    double sum = 0.0;
    for (int i = 0; i < nodes; ++i) sum += density(-1.0 + 2.0 * (i + 0.5) / nodes + v_h) * 2.0 / nodes;
    RC_ASSERT(sum <= 1.0 + 1e-3);
}

RC_GTEST_PROP(BrdfProperty, EnergyFormIsFiniteNonNegativeAndReciprocal, ()) {
    const Grating shape = *grating();
    const glm::dvec3 s = *upper_direction();
    const glm::dvec3 v = *rc::gen::oneOf(upper_direction(), rc::gen::just(glm::dvec3(-s.x, -s.y, s.z)));  // u = 0
    const double wavelength_nm = *wavelength();
    const double f = brdf_energy(shape, s, v, wavelength_nm);
    RC_ASSERT(std::isfinite(f));
    RC_ASSERT(f >= 0.0);
    RC_ASSERT(f == brdf_energy(shape, v, s, wavelength_nm));
}

RC_GTEST_PROP(BrdfProperty, PapersFormLiesBetweenZeroAndOne, ()) {
    Grating shape = *grating();
    shape.profile = SlitProfile{shape.pitch_nm * *uniform(0.0, 1.0)};
    const double f = brdf_agu(shape, *upper_direction(), *upper_direction(), *wavelength());
    RC_ASSERT(f >= 0.0);
    RC_ASSERT(f <= 1.0 + 1e-15);
}

/// ∫ f_E v_n dω ≤ 1 for the flat lobe: over v_g, v_h in the unit disc, the lobe gives √(1−v_g²). 64 nodes across an
/// order's width leave 1e-3 of it.
RC_GTEST_PROP(BrdfProperty, SendsOutNoMoreThanComesIn, ()) {
    Grating shape = *grating();
    RC_PRE(shape.pitch_nm < 5000.0);
    shape.lobe = FlatLobe{};
    shape.grooves = std::min(shape.grooves, 200.0);
    shape.normalization = Normalization::Energy;
    shape.orders = all_orders(shape.pitch_nm);
    shape.orders.insert(std::lower_bound(shape.orders.begin(), shape.orders.end(), 0), 0);
    const glm::dvec3 s = *upper_direction();
    const double wavelength_nm = *wavelength();
    const int nodes = 64 + static_cast<int>(64.0 * shape.grooves * 2.0 * shape.pitch_nm / wavelength_nm);
    double sum = 0.0;
    for (int i = 0; i < nodes; ++i) {
        const double v_g = -1.0 + 2.0 * (i + 0.5) / nodes;
        const double r = std::sqrt(1.0 - v_g * v_g);
        // f does not depend on v_h: ∫ dv_h = 2r.
        sum += brdf_energy(shape, s, {v_g, 0.0, r}, wavelength_nm) * 2.0 * r * 2.0 / nodes;
    }
    RC_ASSERT(sum <= 1.0 + 1e-3);
}

/// d < λ/2: the term is 0, not small and not NaN.
RC_GTEST_PROP(BrdfProperty, FinePitchDoesNotDiffract, ()) {
    Grating shape = *grating();
    const double wavelength_nm = *wavelength();
    shape.pitch_nm = *uniform(50.0, 0.4999 * wavelength_nm);
    shape.profile = *profile(shape.pitch_nm);
    std::erase(shape.orders, 0);
    RC_ASSERT(brdf_energy(shape, *upper_direction(), *upper_direction(), wavelength_nm) == 0.0);
}

colour::LightSpectra any_spectra() {
    const std::string name = *rc::gen::elementOf(colour::illuminant_names());
    return colour::LightSpectra(colour::illuminant(name));
}

/// Sharp orders, or few grooves at a pitch whose blurred kernel is quick to tabulate.
Grating any_grating() {
    Grating shape = *grating();
    if (shape.grooves < kManyGrooves && *whole(0, 3) != 0) shape.grooves = kManyGrooves;
    if (shape.grooves < kManyGrooves) {
        shape.pitch_nm = *uniform(50.0, 400.0);
        shape.profile = SlitProfile{shape.pitch_nm * *uniform(0.0, 1.0)};
    }
    return shape;
}

double path(const Grating& shape) {
    return *rc::gen::oneOf(uniform(-2.0 * shape.pitch_nm, 2.0 * shape.pitch_nm), uniform(-5000.0, 5000.0),
                           rc::gen::element(0.0, 380.0, -780.0, 1e-300));
}

/// Efficiencies, observer and light are non-negative, so k is.
RC_GTEST_PROP(KernelProperty, IsFiniteAndNonNegative, ()) {
    const Grating shape = any_grating();
    const ColourKernel kernel(shape, any_spectra());
    for (int i = 0; i < 20; ++i) {
        const glm::dmat3 k = kernel(path(shape));
        for (int c = 0; c < 3; ++c) RC_ASSERT(is_finite_and_not_negative(k[c]));
    }
    RC_ASSERT(is_finite(kernel.zero_order_xyz()));
}

/// 𝒦 never falls; 1e-15 of its whole rise is rounding of a sum of up to 401 terms.
RC_GTEST_PROP(KernelProperty, AntiderivativeRises, ()) {
    const Grating shape = any_grating();
    const ColourKernel kernel(shape, any_spectra());
    const glm::dmat3 whole_rise = kernel.antiderivative(kernel.end_nm()) - kernel.antiderivative(kernel.begin_nm());
    for (int i = 0; i < 20; ++i) {
        const double x = path(shape);
        const glm::dmat3 rise = kernel.antiderivative(x + *log_uniform(1e-9, 1000.0)) - kernel.antiderivative(x);
        RC_ASSERT(is_finite(rise));
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o) {
                RC_ASSERT(rise[c][o] >= -1e-15 * whole_rise[c][o]);
                RC_ASSERT(rise[c][o] <= whole_rise[c][o] * (1.0 + 1e-14));
            }
    }
}

/// All light is accounted for once: the whole rise of sharp orders is Σ_m ∫ η_m cmf E dλ, at most Σ_m η_m of white.
/// With "energy" that is at most white itself, whose Y is 1; 1e-4: Mallett & Yuksel's basis sums to 1 to 1e-5.
RC_GTEST_PROP(KernelProperty, SendsOutNoMoreThanWhite, ()) {
    Grating shape = *grating(kManyGrooves);
    shape.normalization = Normalization::Energy;
    const ColourKernel kernel(shape, any_spectra());
    const glm::dmat3 rise = kernel.antiderivative(kernel.end_nm()) - kernel.antiderivative(kernel.begin_nm());
    const glm::dvec3 white = (rise + kernel.zero_order_xyz()) * glm::dvec3(1.0);
    RC_ASSERT(white.y <= 1.0 + 1e-4);
}

/// A mean over less and less tends to k: over w within one piece, linear in x, it differs by half the piece's rise. 1
/// nm of λ is a piece, so w ≤ 1e-6 nm leaves 1e-6 of k's step; rounding of 𝒦 is 1e-16 of its rise over w.
RC_GTEST_PROP(KernelProperty, AverageTendsToTheKernel, ()) {
    const Grating shape = *grating(kManyGrooves);
    const ColourKernel kernel(shape, any_spectra());
    const double x = path(shape);
    const double w = *log_uniform(1e-6, 1e-3);
    const glm::dmat3 mean = kernel.average(x, x + w);
    const glm::dmat3 begin = kernel(x);
    const glm::dmat3 end = kernel(x + w);
    const glm::dmat3 rise = kernel.antiderivative(kernel.end_nm()) - kernel.antiderivative(kernel.begin_nm());
    for (int c = 0; c < 3; ++c)
        for (int o = 0; o < 3; ++o) {
            // Between two points of up to one kink, and the jumps of orders that begin or end in between.
            const double room = 1e-14 * rise[c][o] / w + 1e-15 * std::abs(x) / w * std::max(begin[c][o], end[c][o]);
            RC_ASSERT(mean[c][o] >= 0.0 - room);
            RC_ASSERT(mean[c][o] <= begin[c][o] + end[c][o] + room);
        }
}

/// The table's stated error bounds the look-up at any place; 1.5: it was measured at seven places a cell, not
/// everywhere.
RC_GTEST_PROP(KernelTableProperty, KeepsItsWord, ()) {
    const Grating shape = any_grating();
    const ColourKernel kernel(shape, any_spectra());
    const KernelTable table = tabulate(kernel, static_cast<std::size_t>(*whole(2, 600)));
    const glm::dmat3 rise = kernel.antiderivative(kernel.end_nm()) - kernel.antiderivative(kernel.begin_nm());
    const double scale = std::max({largest(rise[0]), largest(rise[1]), largest(rise[2])});
    const double error = interpolation_error(table, kernel);
    RC_ASSERT(std::isfinite(error));
    for (int i = 0; i < 20; ++i) {
        const double x = path(shape);
        const glm::dmat3 difference = table.at(x) - kernel.antiderivative(x);
        for (int c = 0; c < 3; ++c)
            RC_ASSERT(largest(difference[c]) <= (1.5 * error + 1e-7) * scale);  // 1e-7: single precision
    }
}

/// Nothing within reach where 2d < 380 nm.
RC_GTEST_PROP(KernelProperty, FinePitchIsBlack, ()) {
    Grating shape = *grating();
    shape.pitch_nm = *uniform(50.0, 189.9);
    shape.profile = SlitProfile{shape.pitch_nm * *uniform(0.01, 1.0)};
    std::erase(shape.orders, 0);
    const ColourKernel kernel(shape, any_spectra());
    const double reach = 2.0 * shape.pitch_nm;
    RC_ASSERT(kernel.antiderivative(reach) - kernel.antiderivative(-reach) == glm::dmat3(0.0));
}

}  // namespace
}  // namespace rowland::property
