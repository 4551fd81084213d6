// The colour kernel and its table.
#include "modules/diffraction/model/colour_kernel.h"
#include "tests/property/generators.h"

namespace rowland::property {
namespace {

using namespace diffraction;

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
        RC_ASSERT(is_finite(k));
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o) RC_ASSERT(k[c][o] >= 0.0);
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
    RC_ASSERT(std::isfinite(table.error));
    for (int i = 0; i < 20; ++i) {
        const double x = path(shape);
        const glm::dmat3 difference = table.at(x) - kernel.antiderivative(x);
        for (int c = 0; c < 3; ++c)
            RC_ASSERT(largest(difference[c]) <= (1.5 * table.error + 1e-7) * scale);  // 1e-7: single precision
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
