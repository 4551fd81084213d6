#include "engine/colour/sampled_spectrum.h"

#include <gtest/gtest.h>

namespace rowland::colour {
namespace {

TEST(SampledSpectrum, IsLinearBetweenSamplesAndExactAtThem) {
    for (const std::vector<double>& wavelengths :
         {std::vector<double>{400, 410, 420}, std::vector<double>{400, 410, 440}}) {
        const SampledSpectrum spectrum(wavelengths, {1.0, 3.0, 2.0}, Outside::Zero);
        EXPECT_EQ(spectrum(400.0), 1.0);
        EXPECT_EQ(spectrum(410.0), 3.0);
        EXPECT_EQ(spectrum(wavelengths[2]), 2.0);
        EXPECT_DOUBLE_EQ(spectrum(402.5), 1.5);
        EXPECT_DOUBLE_EQ(spectrum(0.5 * (wavelengths[1] + wavelengths[2])), 2.5);
    }
}

TEST(SampledSpectrum, IsZeroOrClampedOutside) {
    const SampledSpectrum zero({400, 410}, {1.0, 3.0}, Outside::Zero);
    const SampledSpectrum clamped({400, 410}, {1.0, 3.0}, Outside::Clamp);
    EXPECT_EQ(zero(399.999), 0.0);
    EXPECT_EQ(zero(410.001), 0.0);
    EXPECT_EQ(clamped(399.999), 1.0);
    EXPECT_EQ(clamped(410.001), 3.0);
}

}  // namespace
}  // namespace rowland::colour
