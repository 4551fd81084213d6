#include <gtest/gtest.h>

#include <glm/matrix.hpp>
#include <numbers>

#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "tests/unit/modules/diffraction/gratings.h"

namespace rowland::diffraction {
namespace {

using test::compact_disc;

/// d ∫ C_i(a) k(d(a+v_g)) da by brute force, PHYSICS §5's own formula: many cells, C_i at their middles, k's mean.
std::vector<glm::dmat3> by_kernel(const Grating& grating, int bands, double v_g) {
    const ColourKernel kernel(grating, colour::LightSpectra());
    const ArcCoefficients arcs(bands, grating.lobe);
    const auto count = static_cast<std::size_t>(bands * bands);
    std::vector<glm::dmat3> result(count, glm::dmat3(0.0));
    std::vector<double> arc(count);
    std::vector<double> tangent(count);
    const int cells = 20000;
    const double step = std::numbers::pi / cells;
    for (int i = 0; i < cells; ++i) {
        const double begin = std::cos((i + 1) * step);
        const double end = std::cos(i * step);
        const glm::dmat3 k = kernel.average(grating.pitch_nm * (begin + v_g), grating.pitch_nm * (end + v_g));
        if (k == glm::dmat3(0.0)) continue;
        std::fill(arc.begin(), arc.end(), 0.0);
        arcs.accumulate(std::cos((i + 0.5) * step), 0.0, 550.0, grating.pitch_nm * (end - begin), arc);
        arcs.to_tangent_frame(arc, tangent);
        for (std::size_t j = 0; j < count; ++j) result[j] += tangent[j] * k;
    }
    return result;
}

/// 1e-6 of the largest coefficient: cells of 1.6e-4 are good for the square of that.
TEST(TransferTerms, AreTheKernelsCorrelationWithArcCoefficients) {
    const TransferTerms terms(compact_disc(), colour::LightSpectra(), 5);
    for (const double v_g : {-0.97, -0.2, 0.0, 0.31, 0.75}) {
        const auto found = terms.coefficients(v_g, 0.0);
        const auto expected = by_kernel(compact_disc(), 5, v_g);
        double largest = 0.0;
        double error = 0.0;
        for (std::size_t i = 0; i < found.size(); ++i)
            for (int c = 0; c < 3; ++c)
                for (int o = 0; o < 3; ++o) {
                    largest = std::max(largest, std::abs(expected[i][c][o]));
                    error = std::max(error, std::abs(found[i][c][o] - expected[i][c][o]));
                }
        EXPECT_LT(error, 1e-6 * largest) << v_g;
    }
}

/// A lobe's terms against the trapezoid sum over every nanometre that the spikes take, order 0 included; their step
/// leaves 1e-4 where an arc meets the horizon.
TEST(TransferTerms, OfALobeSumTheViewsSpectrum) {
    const Grating grating{
        .pitch_nm = 1000.0, .profile = BlazedProfile{150.0}, .orders = {-1, 0, 1, 2}, .lobe = GaussianLobe{0.3}};
    const TransferTerms terms(grating, colour::LightSpectra(), 4);
    const ViewSpectrum spectrum(grating, 4);
    const auto kernel = [](double wavelength_nm) {
        return glm::outerProduct(colour::cie_xyz(wavelength_nm), colour::LightSpectra()(wavelength_nm));
    };
    const auto found = terms.coefficients(0.3, -0.4);
    const auto coefficients = spectrum.coefficients(0.3, -0.4);
    for (std::size_t i = 0; i < 16; ++i) {
        glm::dmat3 expected(0.0);
        for (std::size_t j = 0; j < kWavelengths; ++j)
            expected += coefficients[j * 16 + i] * kernel(colour::kVisibleMin + static_cast<double>(j));
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o) EXPECT_NEAR(found[i][c][o], expected[c][o], 1e-5) << i;
    }
}

}  // namespace
}  // namespace rowland::diffraction
