#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>

#include "engine/colour/spectrum.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/bake/view_spectrum.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/representations/transfer/transfer_table.h"
#include "tests/support/files.h"
#include "tests/unit/modules/diffraction/representations/baked_views.h"

namespace rowland::diffraction {
namespace {

using test::relative_rms;

Grating transfer_disc() {
    Grating grating;
    grating.pitch_nm = 1600.0;
    grating.profile = SlitProfile{800.0};
    return grating;
}

Grating transfer_foil() {
    Grating grating;
    grating.pitch_nm = 1000.0;
    grating.profile = BlazedProfile{150.0};
    grating.lobe = GaussianLobe{0.3};
    return grating;
}

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
    const TransferTerms terms(transfer_disc(), colour::LightSpectra(), 5);
    for (const double v_g : {-0.97, -0.2, 0.0, 0.31, 0.75}) {
        const auto found = terms.coefficients(v_g, 0.0);
        const auto expected = by_kernel(transfer_disc(), 5, v_g);
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
    Grating grating = transfer_foil();
    grating.orders = {-1, 0, 1, 2};
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

/// PHYSICS §9: 1e-4 on the flat cases, by the default table (256 nodes, fp16).
TEST(TransferTable, MatchesTheBandlimitedOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    int flat_cases = 0;
    for (const test::OracleCase& one : test::read_cases(path)) {
        if (!is_flat(one.grating.lobe)) continue;
        ++flat_cases;
        const TransferTable table = bake(one.grating, TransferSettings{});
        const double error = relative_rms(test::evaluated(table, test::tangent_views(light, one.frames)), one.xyz);
        RecordProperty(one.name, fmt::format("{:.3g}", error));
        EXPECT_LT(error, 1e-4) << one.name;
    }
    EXPECT_EQ(flat_cases, 4);
}

/// The foil's lobe by the default table, 64 × 32: .3 % of interpolation on other frames (measured), 1 % allowed.
TEST(TransferTable, MatchesTheBandlimitedOracleForALobe) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const lighting::ShLight light = test::read_sh_light(light_path);
    const test::OracleCase one = test::read_cases(path).back();
    ASSERT_EQ(one.name, "foil_lobe");
    TransferSettings settings;
    settings.grid = ViewGrid{ViewMapping::Spherical, 64, 32};
    const double error =
        relative_rms(test::evaluated(bake(one.grating, settings), test::tangent_views(light, one.frames)), one.xyz);
    RecordProperty("error", fmt::format("{:.3g}", error));
    EXPECT_LT(error, 0.01);
}

/// Coefficient 6 of light of green, in Z, at node 9: layer (1·3 + 2)·L + 1, component 2.
TEST(TransferTable, HasTheLayoutTheShaderReads) {
    TransferSettings settings;
    settings.grid = ViewGrid{ViewMapping::OneDimensional, 17, 1};
    settings.storage = Storage::Float;
    const TransferTable table = bake(transfer_disc(), settings);
    EXPECT_EQ(harmonic_layers(5), 7);
    EXPECT_EQ(table.scale.size(), 63U);
    const TransferTerms terms(transfer_disc(), colour::LightSpectra(), 5);
    const double expected = terms.coefficients(2.0 * 9 / 16 - 1.0, 0.0)[6][1][2];
    const std::size_t layer = (1 * 3 + 2) * 7 + 1;
    EXPECT_NEAR(reinterpret_cast<const float*>(table.texels.data())[(layer * 17 + 9) * 4 + 2], expected, 1e-7);
    EXPECT_NE(expected, 0.0);
}

TEST(TransferTable, MirroredViewsAreBakedOnce) {
    TransferSettings settings;
    settings.bands = 3;
    settings.grid = ViewGrid{ViewMapping::Parabolic, 9, 9};
    settings.storage = Storage::Float;
    const TransferTable table = bake(transfer_foil(), settings);
    const TransferTerms terms(transfer_foil(), colour::LightSpectra(), 3);
    for (const int row : {1, 7}) {
        const glm::dvec2 v = node_view(*settings.grid, 3, row);
        const auto exact = terms.coefficients(v.x, v.y);
        for (std::size_t i = 0; i < 9; ++i) {
            const std::size_t layer = i / 4;  // red light, X
            EXPECT_NEAR(table.value(layer, layer * 81 + static_cast<std::size_t>(row) * 9 + 3, i % 4), exact[i][0][0],
                        1e-7);
        }
    }
}

TEST(TransferTable, ViewBelowTheHorizonIsBlack) {
    const TransferTable table = bake(transfer_disc(), TransferSettings{.bands = 2});
    const lighting::ShLight light{1, {glm::dvec3(1.0)}};
    EXPECT_EQ(evaluate(table, light, {0.6, 0.0, -0.8}), glm::dvec3(0.0));
    EXPECT_GT(evaluate(table, light, {0.6, 0.0, 0.8}).y, 0.0);
}

TEST(TransferTable, RefusesFewGroovesAndOneDimensionForALobe) {
    Grating few = transfer_disc();
    few.grooves = 10.0;
    EXPECT_THROW(bake(few, TransferSettings{}), Error);
    TransferSettings settings;
    settings.grid = ViewGrid{ViewMapping::OneDimensional, 16, 1};
    EXPECT_THROW(bake(transfer_foil(), settings), Error);
}

TEST(TransferTable, SubwavelengthPitchIsExactlyBlack) {
    Grating grating = transfer_disc();
    grating.pitch_nm = 150.0;
    grating.profile = SlitProfile{75.0};
    const TransferTable table = bake(grating, TransferSettings{});
    EXPECT_EQ(evaluate(table, {1, {glm::dvec3(1.0)}}, {0.3, 0.1, 0.9}), glm::dvec3(0.0));
}

TEST(TransferTable, BytesDoNotDependOnTheNumberOfThreads) {
    const auto bytes = [](unsigned threads) {
        const ThreadLimit limit(threads);
        TransferSettings settings;
        settings.bands = 3;
        settings.grid = ViewGrid{ViewMapping::Spherical, 8, 4};
        ByteWriter writer;
        write(bake(transfer_foil(), settings), writer);
        return writer.take();
    };
    EXPECT_EQ(bytes(1), bytes(2));
}

TEST(TransferTable, HasSoundBytes) {
    for (const Storage storage : {Storage::Unorm16, Storage::Half, Storage::Float, Storage::Unorm8}) {
        TransferSettings settings;
        settings.bands = 2;
        settings.grid = ViewGrid{ViewMapping::OneDimensional, 9, 1};
        settings.storage = storage;
        test::expect_sound_bytes(bake(transfer_disc(), settings), read_transfer_table);
    }
}

}  // namespace
}  // namespace rowland::diffraction
