// Light probes with bad texels and light of every strength, cooked and read back.
#include <algorithm>
#include <limits>

#include "engine/colour/light_spectra.h"
#include "engine/core/error.h"
#include "engine/lighting/light_probe.h"
#include "tests/property/generators.h"
#include "tests/support/evaluate_irradiance.h"

namespace rowland::property {
namespace {

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
    TexelReport expected;
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

/// Hostile bytes are refused with an Error, or are another sane probe.
RC_GTEST_PROP(LightProbeProperty, BrokenBytesNeverCrash, ()) {
    std::vector<std::byte> bytes = serialise(any_probe());
    for (int i = 0; i < *whole(1, 8); ++i)
        bytes[static_cast<std::size_t>(*whole(0, static_cast<int>(bytes.size()) - 1))] =
            static_cast<std::byte>(*whole(0, 255));
    if (*whole(0, 1) == 1) bytes.resize(static_cast<std::size_t>(*whole(0, static_cast<int>(bytes.size()))));
    try {
        const LightProbe probe = deserialise(bytes, "broken.probe");
        RC_ASSERT(std::isfinite(colour::luminous_power(probe.illuminant)));
    } catch (const Error& error) {
        RC_ASSERT(error.info().fault == Fault::Input);
    }
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
