// Spherical harmonics, their rotation, windows and quadrature; probes with bad texels and light of every strength,
// cooked and read back.
#include <limits>

#include "engine/math/quadrature.h"
#include "tests/property/generators.h"
#include "tests/support/light.h"

namespace rowland::property {
namespace {

using namespace math;

/// PHYSICS §8: Σ_m Y_lm² = (2l+1)/4π in every direction; 1e-12 relative.
RC_GTEST_PROP(ShProperty, SquaresOfABandAddUp, ()) {
    const int bands = *whole(1, kMaximumBands);
    std::vector<double> y(static_cast<std::size_t>(sh_count(bands)));
    evaluate_sh(*direction(), bands, y);
    for (int l = 0; l < bands; ++l) {
        double sum = 0.0;
        for (int m = -l; m <= l; ++m) {
            const double value = y[static_cast<std::size_t>(sh_index(l, m))];
            sum += value * value;
        }
        const double expected = (2 * l + 1) / (4.0 * std::numbers::pi);
        RC_ASSERT(std::abs(sum - expected) <= 1e-12 * expected);
    }
}

/// PHYSICS §8: R Rᵀ = 1 to 1e-12 for 16 bands.
RC_GTEST_PROP(ShRotationProperty, IsOrthogonal, ()) {
    const ShRotation r(*rotation(), 16);
    for (int l = 0; l < 16; ++l)
        for (int i = -l; i <= l; ++i)
            for (int j = i; j <= l; ++j) {
                double product = 0.0;
                for (int k = -l; k <= l; ++k) product += r.entry(l, i, k) * r.entry(l, j, k);
                RC_ASSERT(std::abs(product - (i == j ? 1.0 : 0.0)) <= 1e-12);
            }
}

/// PHYSICS §8: R(ab) = R(a) R(b) to 1e-12.
RC_GTEST_PROP(ShRotationProperty, Composes, ()) {
    const glm::dmat3 a = *rotation();
    const glm::dmat3 b = *rotation();
    const ShRotation ra(a, 16);
    const ShRotation rb(b, 16);
    const ShRotation rab(a * b, 16);
    for (int l = 0; l < 16; ++l)
        for (int i = -l; i <= l; ++i)
            for (int j = -l; j <= l; ++j) {
                double product = 0.0;
                for (int k = -l; k <= l; ++k) product += ra.entry(l, i, k) * rb.entry(l, k, j);
                RC_ASSERT(std::abs(product - rab.entry(l, i, j)) <= 1e-12);
            }
}

/// f'(M s) = f(s). Errors of 1e-13 a basis function (32 bands) over as many terms as there are: 1e-11 of Σ|c|.
RC_GTEST_PROP(ShRotationProperty, TurnsTheFunction, ()) {
    const lighting::ShLight light = *sh_light(kMaximumBands);
    const glm::dmat3 m = *rotation();
    const glm::dvec3 s = *direction();
    std::vector<glm::dvec3> turned(light.coefficients.size());
    ShRotation(m, light.bands).apply(std::span<const glm::dvec3>(light.coefficients), turned);
    std::vector<double> here(turned.size());
    std::vector<double> there(turned.size());
    evaluate_sh(s, light.bands, here);
    evaluate_sh(m * s, light.bands, there);
    glm::dvec3 difference(0.0);
    for (std::size_t i = 0; i < turned.size(); ++i)
        difference += there[i] * turned[i] - here[i] * light.coefficients[i];
    RC_ASSERT(largest(difference) <= 1e-11 * total(light));
}

/// A turn by ε moves what it turns by no more than l ε in band l: near the identity nothing jumps. 1e-12: rounding.
RC_GTEST_PROP(ShRotationProperty, IsContinuousAtTheIdentity, ()) {
    const double angle = *log_uniform(1e-16, 1e-4);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const ShRotation r(glm::dmat3(c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0), 16);
    for (int l = 0; l < 16; ++l)
        for (int i = -l; i <= l; ++i)
            for (int j = -l; j <= l; ++j)
                RC_ASSERT(std::abs(r.entry(l, i, j) - (i == j ? 1.0 : 0.0)) <= l * angle + 1e-12);
}

RC_GTEST_PROP(ShWindowProperty, FallsFromOneAndStaysPositive, ()) {
    const auto window = *rc::gen::element(SphericalWindow::None, SphericalWindow::Lanczos, SphericalWindow::Hann);
    const int bands = *whole(1, kMaximumBands);
    double before = 1.0;
    RC_ASSERT(window_factor(window, 0, bands) == 1.0);
    for (int l = 0; l < bands; ++l) {
        const double factor = window_factor(window, l, bands);
        RC_ASSERT(factor > 0.0);
        RC_ASSERT(factor <= before);
        before = factor;
    }
    RC_ASSERT(std::isfinite(clamped_cosine_factor(bands)));
}

/// Weights are positive and add up to the length; powers up to x³ (where there are two nodes) integrate exactly. 1e-13:
/// rounding of up to 400 terms.
RC_GTEST_PROP(QuadratureProperty, IntegratesCubicsOnAnyInterval, ()) {
    const int count = *whole(2, 400);
    const double a = *uniform(-10.0, 10.0);
    const double b = a + *log_uniform(1e-6, 10.0);
    const QuadratureRule rule = gauss_legendre(count, a, b);
    double before = a;
    double length = 0.0;
    double cubic = 0.0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        RC_ASSERT(rule.weights[i] > 0.0);
        RC_ASSERT(rule.nodes[i] > before);
        before = rule.nodes[i];
        length += rule.weights[i];
        const double t = (rule.nodes[i] - a) / (b - a);
        cubic += rule.weights[i] * t * t * t;
    }
    RC_ASSERT(std::abs(length - (b - a)) <= 1e-13 * (b - a));
    // t itself carries a's rounding.
    RC_ASSERT(std::abs(cubic / (b - a) - 0.25) <= 1e-13 + 4e-16 * std::abs(a) / (b - a));
}

using namespace lighting;

/// Light over twelve decades, and what is none: NaN, infinite, negative.
rc::Gen<float> texel() {
    return rc::gen::oneOf(
        rc::gen::map(log_uniform(1e-6, 1e6), [](double x) { return static_cast<float>(x); }),
        rc::gen::map(uniform(0.0, 2.0), [](double x) { return static_cast<float>(x); }),
        rc::gen::element(0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity(), 1e-45F, 3e38F));
}

image::Image any_image() {
    const int height = *whole(1, 8);
    image::Image image{2 * height, height, {}};
    for (int i = 0; i < 2 * height * height; ++i) image.texels.emplace_back(*texel(), *texel(), *texel());
    return image;
}

double brightest(const image::Image& image) {
    double largest_value = 0.0;
    for (const glm::vec3& t : image.texels) largest_value = std::max(largest_value, largest(glm::dvec3(t)));
    return largest_value;
}

/// A texel that is no light is counted once, for the worst of its channels, and replaced; every look-up is within the
/// image's own range.
RC_GTEST_PROP(ProbeProperty, BadTexelsAreCountedAndGone, ()) {
    const image::Image image = any_image();
    InvalidTexelCounts expected;
    for (const glm::vec3& t : image.texels) {
        const auto any = [&t](const auto& is_bad) { return is_bad(t.x) || is_bad(t.y) || is_bad(t.z); };
        if (any([](float x) { return std::isnan(x); }))
            ++expected.nan;
        else if (any([](float x) { return std::isinf(x); }))
            ++expected.infinite;
        else if (any([](float x) { return x < 0.0F; }))
            ++expected.negative;
    }
    const ProbeImage probe(image, Mapping::Equirectangular);
    RC_ASSERT(probe.report().nan == expected.nan);
    RC_ASSERT(probe.report().infinite == expected.infinite);
    RC_ASSERT(probe.report().negative == expected.negative);
    const glm::dvec3 radiance = probe.radiance(*direction());
    RC_ASSERT(is_finite(radiance));
    RC_ASSERT(radiance.x >= 0.0 && radiance.y >= 0.0 && radiance.z >= 0.0);
    RC_ASSERT(largest(radiance) <= brightest(probe.image()) * (1.0 + 1e-15));  // rounding of a mean of four
}

/// |l_i| ≤ ∫ L |Y_i| ≤ 4π max L · √((2l+1)/4π), and the mean radiance is not negative.
RC_GTEST_PROP(ProbeProperty, ProjectionIsBounded, ()) {
    const ProbeImage probe(any_image(), Mapping::Equirectangular);
    const ShLight light = project(probe, *whole(1, math::kMaximumBands));
    const double bound = 4.0 * std::numbers::pi * brightest(probe.image());
    for (int l = 0; l < light.bands; ++l)
        for (int m = -l; m <= l; ++m) {
            const glm::dvec3& c = light.coefficients[static_cast<std::size_t>(math::sh_index(l, m))];
            RC_ASSERT(is_finite(c));
            RC_ASSERT(largest(c) <= bound * std::sqrt((2 * l + 1) / (4.0 * std::numbers::pi)) * (1.0 + 1e-12));
        }
    const glm::dvec3& mean = light.coefficients[0];
    RC_ASSERT(mean.x >= 0.0 && mean.y >= 0.0 && mean.z >= 0.0);
}

/// PHYSICS §7: the ambient's window keeps E from going negative; 1e-3 of the mean between the directions it looked at.
RC_GTEST_PROP(ProbeProperty, AmbientIsNotNegative, ()) {
    const ProbeImage probe(any_image(), Mapping::Equirectangular);
    const AmbientLight ambient = ambient_coefficients(project(probe, 5));
    const glm::dvec3 e = test::evaluate_irradiance(ambient, *direction());
    RC_ASSERT(is_finite(e));
    const double mean = largest(ambient.coefficients[0]);
    RC_ASSERT(std::min({e.x, e.y, e.z}) >= -1e-3 * mean);
}

/// Half floats under a common scale: 2⁻¹¹ of a value, or half a step of the smallest, 2⁻²⁵ of the scale.
RC_GTEST_PROP(PackProperty, HalvesKeepElevenBits, ()) {
    EnvironmentMap map{.layout = {.face_size = 2, .levels = 1}, .texels = {}};
    for (int i = 0; i < 24; ++i) {
        glm::vec3 value;
        for (int c = 0; c < 3; ++c) {
            const float x = *texel();
            value[c] = std::isfinite(x) ? std::abs(x) : 0.0F;
        }
        map.texels.push_back(value);
    }
    const PackedEnvironmentMap packed = pack(map);
    const EnvironmentMap back = unpack(packed);
    for (std::size_t i = 0; i < map.texels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const auto value = static_cast<double>(map.texels[i][c]);
            const auto found = static_cast<double>(back.texels[i][c]);
            RC_ASSERT(std::isfinite(found));
            RC_ASSERT(std::abs(found - value) <=
                      std::max(std::ldexp(value, -11), std::ldexp(static_cast<double>(packed.scale), -25)));
        }
}

colour::Illuminant any_illuminant() {
    std::vector<double> wavelengths_nm = {380.0 + *uniform(0.0, 100.0)};
    std::vector<double> power = {*log_uniform(1e-6, 1e6)};
    for (int i = 0; i < *whole(1, 20); ++i) {
        wavelengths_nm.push_back(wavelengths_nm.back() + *uniform(1.5, 30.0));
        power.push_back(*rc::gen::oneOf(log_uniform(1e-6, 1e6), rc::gen::element(0.0)));
    }
    return {.name = "lamp.csv",
            .power = colour::SampledSpectrum(std::move(wavelengths_nm), std::move(power), colour::Outside::Zero)};
}

LightProbe any_probe() {
    LightProbe probe;
    probe.sh = *sh_light(8);
    probe.illuminant = any_illuminant();
    probe.environment.layout = {.face_size = 4, .levels = 2};
    probe.environment.halves.assign(3 * probe.environment.layout.offset(2), 0x3c00);
    return probe;
}

RC_GTEST_PROP(LightProbeProperty, SurvivesSerialisation, ()) {
    const LightProbe probe = any_probe();
    const std::vector<std::byte> bytes = serialise(probe);
    RC_ASSERT(serialise(deserialise(bytes, "a.probe")) == bytes);
}

/// Light of colour rgb has a finite XYZ under any lamp, and white's Y is 1 whatever the lamp.
RC_GTEST_PROP(SpectraProperty, WhiteHasLuminanceOne, ()) {
    const colour::LightSpectra spectra(any_illuminant());
    const glm::dvec3 white = colour::rgb_to_xyz(spectra, glm::dvec3(1.0));
    RC_ASSERT(is_finite(white));
    // Mallett & Yuksel's table adds up to 1 to 1e-5.
    RC_ASSERT(std::abs(white.y - 1.0) <= 1e-4);
}

}  // namespace
}  // namespace rowland::property
