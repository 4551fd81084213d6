#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "engine/math/fourier_transform.h"
#include "engine/math/quadrature.h"

namespace rowland::math {

namespace {

TEST(Quadrature, IntegratesPolynomialsOfDegree2nMinus1Exactly) {
    for (const int count : {1, 2, 3, 4, 5, 8, 16, 33, 64}) {
        const QuadratureRule rule = gauss_legendre(count, -0.5, 2);
        ASSERT_EQ(rule.nodes.size(), static_cast<std::size_t>(count));
        for (int degree = 0; degree < 2 * count; ++degree) {
            double sum = 0;
            double scale = 0;
            for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
                sum += rule.weights[i] * std::pow(rule.nodes[i] / 2, degree);
                scale += rule.weights[i] * std::pow(std::abs(rule.nodes[i] / 2), degree);
            }
            const double exact = 2 * (1 - std::pow(-0.25, degree + 1)) / (degree + 1);
            // Rounding: `count` terms, each wrong by a few units of 2e-16, `degree` of them from the power.
            EXPECT_NEAR(sum, exact, 1e-15 * (degree + 4) * scale) << count << " nodes, degree " << degree;
        }
    }
}

TEST(Quadrature, NodesAscendInsideTheInterval) {
    const QuadratureRule rule = gauss_legendre(31, 3, 4);
    EXPECT_TRUE(std::is_sorted(rule.nodes.begin(), rule.nodes.end()));
    EXPECT_GT(rule.nodes.front(), 3);
    EXPECT_LT(rule.nodes.back(), 4);
    EXPECT_NEAR(rule.nodes[15], 3.5, 1e-15);
}

TEST(Quadrature, MatchesPublishedFivePointRule) {
    // Abramowitz & Stegun 1964, table 25.4.
    const QuadratureRule rule = gauss_legendre(5, -1, 1);
    EXPECT_NEAR(rule.nodes[4], 0.906179845938663993, 1e-15);
    EXPECT_NEAR(rule.nodes[3], 0.538469310105683091, 1e-15);
    EXPECT_NEAR(rule.weights[4], 0.236926885056189088, 1e-15);
    EXPECT_NEAR(rule.weights[2], 0.568888888888888889, 1e-15);
}

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
