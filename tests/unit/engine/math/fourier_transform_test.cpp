#include "engine/math/fourier_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace rowland::math {
namespace {

constexpr std::size_t kLanes = FourierTransform::kLanes;

/// Against the sum that defines it, every lane with other numbers; sizes of an even and an odd number of stages.
TEST(FourierTransform, EqualsTheSum) {
    for (const std::size_t size : {1U, 2U, 8U, 16U, 64U}) {
        std::vector<float> real(kLanes * size);
        std::vector<float> imaginary(kLanes * size);
        for (std::size_t i = 0; i < real.size(); ++i) {
            real[i] = std::sin(1.7F * static_cast<float>(i));
            imaginary[i] = std::cos(0.9F * static_cast<float>(i * i));
        }
        const std::vector<float> given_real = real;
        const std::vector<float> given_imaginary = imaginary;
        std::vector<float> work_real(real.size());
        std::vector<float> work_imaginary(real.size());
        const FourierTransform transform(size);
        transform({real, imaginary}, {work_real, work_imaginary});
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            for (std::size_t k = 0; k < size; ++k) {
                std::complex<double> sum = 0.0;
                for (std::size_t j = 0; j < size; ++j)
                    sum += std::complex<double>(given_real[kLanes * j + lane], given_imaginary[kLanes * j + lane]) *
                           std::polar(1.0,
                                      2.0 * std::numbers::pi * static_cast<double>(j * k) / static_cast<double>(size));
                EXPECT_NEAR(real[kLanes * k + lane], sum.real(), 1e-5) << size << " " << k;
                EXPECT_NEAR(imaginary[kLanes * k + lane], sum.imag(), 1e-5) << size << " " << k;
            }
    }
}

}  // namespace
}  // namespace rowland::math
