#include "modules/diffraction/representations/bins/bin_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>

#include "engine/colour/light_spectra.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/bake/wavelength_cuts.h"
#include "tests/support/test_data.h"
#include "tests/unit/modules/diffraction/representations/baked_views.h"

namespace rowland::diffraction {
namespace {

using test::relative_rms;

Grating binned_disc() {
    Grating grating;
    grating.pitch_nm = 1600.0;
    grating.profile = SlitProfile{800.0};
    return grating;
}

BinSettings small(int bins) {
    BinSettings settings;
    settings.bins = bins;
    settings.grid = {ViewMapping::OneDimensional, 256, 1};
    settings.storage = Storage::Float;
    return settings;
}

/// Bins converge with the square of their number; one a nanometre leaves the table's 1e-5.
TEST(BinTable, ConvergesToTheBandlimitedOracle) {
    ROWLAND_TEST_DATA(path, "oracle/radiance_bandlimited.csv");
    ROWLAND_TEST_DATA(light_path, "oracle/bandlimited_light_n5.csv");
    const test::OracleCase one = test::read_cases(path).front();
    const auto views = test::tangent_views(test::read_sh_light(light_path), one.frames);
    double before = 1.0;
    for (const auto& [bins, bound] : {std::pair{4, 0.01}, {8, 0.003}, {16, 0.001}, {400, 1e-4}}) {
        const double error = relative_rms(test::evaluated(bake(one.grating, small(bins)), views), one.xyz);
        RecordProperty(fmt::format("bins_{}", bins), fmt::format("{:.3g}", error));
        EXPECT_LT(error, bound) << bins;
        EXPECT_LT(error, before) << bins;
        before = error;
    }
}

TEST(BinTable, ColoursSumToTheLightsWhite) {
    const BinTable table = bake(binned_disc(), small(7));
    EXPECT_EQ(table.bins(), 7);
    const glm::dmat3 sum =
        std::accumulate(table.colours.begin(), table.colours.end(), glm::dmat3(0.0),
                        [](const glm::dmat3& total, const glm::mat3& colour) { return total + glm::dmat3(colour); });
    const glm::dvec3 white = sum * glm::dvec3(1.0);
    const glm::dvec3 expected = colour::rgb_to_xyz(colour::LightSpectra(), glm::dvec3(1.0));
    for (int o = 0; o < 3; ++o) EXPECT_NEAR(white[o], expected[o], 1e-6);  // floats
}

/// A lamp of lines leaves most bins dark: no division by nothing.
TEST(BinTable, TakesALampOfLines) {
    BinSettings settings = small(40);
    settings.illuminant = {
        "line", colour::SampledSpectrum({500.0, 545.0, 546.0, 547.0, 700.0}, {0, 0, 1, 0, 0}, colour::Outside::Zero)};
    const BinTable table = bake(binned_disc(), settings);
    const glm::dvec3 xyz = evaluate(table, {1, {glm::dvec3(1.0)}}, {0.3, 0.1, 0.9486833});
    EXPECT_TRUE(std::isfinite(xyz.x + xyz.y + xyz.z));
    EXPECT_GT(xyz.y, 0.0);
}

TEST(BinTable, RefusesFewGrooves) {
    Grating few = binned_disc();
    few.grooves = 10.0;
    EXPECT_THROW(bake(few, small(4)), Error);
}

TEST(BinTable, BytesDoNotDependOnTheNumberOfThreads) {
    const auto bytes = [](unsigned threads) {
        const ThreadLimit limit(threads);
        BinSettings settings;
        settings.bands = 3;
        settings.grid = {ViewMapping::Parabolic, 5, 5};
        ByteWriter writer;
        write(bake(binned_disc(), settings), writer);
        return writer.take();
    };
    EXPECT_EQ(bytes(1), bytes(2));
}

TEST(BinTable, HasSoundBytes) {
    BinSettings settings = small(3);
    settings.bands = 2;
    settings.grid.columns = 9;
    test::expect_sound_bytes(bake(binned_disc(), settings), read_bin_table);
}

TEST(WavelengthCuts, CutEqualWeightsIntoEqualLengths) {
    const std::vector<double> even(401, 2.0);
    EXPECT_EQ(equal_weight_cuts(even, 4), (std::vector<std::size_t>{0, 100, 200, 300, 400}));
}

TEST(WavelengthCuts, GiveEveryPartAStep) {
    std::vector<double> spike(21, 0.0);
    spike[3] = 1.0;
    for (int parts = 1; parts <= 20; ++parts) {
        const auto cuts = equal_weight_cuts(spike, parts);
        ASSERT_EQ(cuts.size(), static_cast<std::size_t>(parts) + 1);
        EXPECT_EQ(cuts.front(), 0U);
        EXPECT_EQ(cuts.back(), 20U);
        for (std::size_t k = 0; k + 1 < cuts.size(); ++k) EXPECT_LT(cuts[k], cuts[k + 1]);
    }
}

}  // namespace
}  // namespace rowland::diffraction
