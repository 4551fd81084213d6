#include "modules/thin_film/bake/film_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/lighting/lobe_angles.h"
#include "tests/support/csv.h"
#include "tests/support/test_data.h"

namespace rowland::thin_film {
namespace {

const Film kSoap{.layers = {{1.33, 400.0}}, .base = std::complex<double>(1.0)};
const Film kTitanium{.layers = {{2.4, 100.0}}, .base = std::complex<double>(2.5, 3.3)};

FilmTable bake(const Film& film, const TableRange& range) {
    return bake_table(FilmColour(film, colour::LightSpectra{}), range, table_size(range));
}

double largest(const glm::dmat3& matrix) {
    double result = 0.0;
    for (int c = 0; c < 9; ++c) result = std::max(result, std::abs(matrix[c / 3][c % 3]));
    return result;
}

/// The promise: 1 % of the largest of its row everywhere, 0.3 % RMS, 64 kB.
void expect_within_budget(const FilmTable& table) {
    EXPECT_LE(table.error.largest, 0.01);
    EXPECT_LE(table.error.rms, 0.003);
    EXPECT_LE(table.bytes(), 64U * 1024U);
}

TEST(FilmTable, OfOneThicknessIsWithinItsBudgetForEveryRoughness) {
    expect_within_budget(bake(kSoap, {400.0, 400.0, 0.0, 1.0}));
}

TEST(FilmTable, OfGltfsDefaultThicknessesIsWithinItsBudget) {
    expect_within_budget(bake(kSoap, {100.0, 400.0, 0.4, 0.4}));
    expect_within_budget(bake(kTitanium, {100.0, 400.0, 0.0, 0.0}));
}

TEST(FilmTable, OfAWideRangeOfThicknessesIsWithinItsBudget) {
    for (const Film& film : {kSoap, kTitanium, Film{.layers = {{1.77, 400.0}}, .base = colour::Metal::Al}})
        expect_within_budget(bake(film, {0.0, 1200.0, 0.0, 0.0}));
}

TEST(FilmTable, OfAWideRangeOfThicknessesOnARoughSurfaceIsWithinItsBudget) {
    expect_within_budget(bake(kSoap, {0.0, 800.0, 0.7, 0.7}));
}

TEST(FilmTable, OfSeveralThicknessesAndRoughnessesIsWithinItsBudget) {
    for (const Film& film : {kSoap, kTitanium}) expect_within_budget(bake(film, {100.0, 400.0, 0.0, 0.6}));
}

TEST(FilmTable, MatchesTheOracleWithinOnePercent) {
    ROWLAND_TEST_DATA(path, "oracle/thin_film_reflectance.csv");
    const rowland::test::Csv oracle = rowland::test::read_csv(path);
    std::string baked_for;
    FilmTable table;
    for (std::size_t row = 0; row < oracle.rows.size(); ++row) {
        const double thickness_nm = oracle.number(row, "thickness_nm");
        const std::string& base = oracle.text(row, "base");
        const std::string film = base + " " + oracle.text(row, "film_ior") + " " + oracle.text(row, "thickness_nm");
        if (film != baked_for) {
            const Base under = base == "air"         ? Base(std::complex<double>(1.0))
                               : base == "glass_1.5" ? Base(std::complex<double>(1.5))
                                                     : Base(colour::parse_metal(base).value());
            table = bake({.layers = {{oracle.number(row, "film_ior"), thickness_nm}}, .base = under},
                         {thickness_nm, thickness_nm, 0.0, 0.0});
            baked_for = film;
        }
        const glm::dvec3 found = table.at(oracle.number(row, "cosine"), thickness_nm, 0.0) * glm::dvec3(1.0);
        const glm::dvec3 expected(oracle.number(row, "X"), oracle.number(row, "Y"), oracle.number(row, "Z"));
        const double scale = std::max({expected.x, expected.y, expected.z});
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], expected[c], 0.01 * scale + 1e-20) << film;
    }
}

TEST(FilmTable, OfARoughSurfaceIsTheMeanOverTheLobesMicrofacets) {
    // Slow and obvious: the exact sum at every sampled half vector.
    const TableRange range{400.0, 400.0, 0.5, 0.5};
    const FilmTable table = bake(kSoap, range);
    const FilmColour colour(kSoap, colour::LightSpectra{});
    for (const double cosine : {0.2, 0.9}) {
        glm::dmat3 sum(0.0);
        double weights = 0.0;
        int i = 0;
        lighting::sample_lobe(cosine, 0.5, [&](double on_facet, double weight) {
            if (i++ % 5 != 0) return;
            sum += weight * colour(on_facet);
            weights += weight;
        });
        const glm::dmat3 expected = sum / weights;
        EXPECT_LE(largest(table.at(cosine, 400.0, 0.5) - expected), 0.01 * largest(expected)) << cosine;
    }
}

TEST(FilmTable, RowsFollowTheMeanSquareCosineOfTheLobe) {
    for (const double roughness : {0.0, 0.1, 0.3, 0.5, 0.7, 1.0})
        for (const double cosine : {0.05, 0.2, 0.5, 0.8, 1.0}) {
            double sum = 0.0;
            double weights = 0.0;
            lighting::sample_lobe(cosine, roughness, [&](double on_facet, double weight) {
                sum += weight * on_facet * on_facet;
                weights += weight;
            });
            // The formula's own error, measured.
            EXPECT_NEAR(mean_square_cosine(cosine, roughness), sum / weights, 0.05) << roughness << " " << cosine;
        }
}

TEST(FilmTable, StoresEachColumnToTwoThousandthsOfItsLargest) {
    const glm::mat3 matrix(0.9F, 0.4F, 0.003F, 3e-3F, 1e-3F, 2e-3F, 1e-4F, 0.0F, 0.07F);
    const glm::mat3 stored = to_stored(matrix);
    for (int c = 0; c < 3; ++c) {
        const float scale = std::max({matrix[c].x, matrix[c].y, matrix[c].z});
        // Half a step of nine bits of a number that is at least half of the exponent's.
        for (int r = 0; r < 3; ++r) EXPECT_NEAR(stored[c][r], matrix[c][r], scale / 511.0F) << c << " " << r;
    }
    EXPECT_EQ(to_stored(glm::mat3(-1.0F)), glm::mat3(0.0F));
}

TEST(FilmTable, OfASmoothLobeIsTheMirrors) {
    const std::vector<double> angles = lighting::lobe_angles(0.49, 0.01, 100);
    EXPECT_GT(angles[70], 0.9);
}

TEST(FilmTable, OfAFilmOfAirAndOfNoThicknessIsFinite) {
    for (const Film& film : {Film{.layers = {{1.0, 300.0}}, .base = std::complex<double>(1.5)},
                             Film{.layers = {{1.3, 0.0}}, .base = std::complex<double>(1.0)},
                             Film{.layers = {{1.3, 1e5}}, .base = colour::Metal::Al}}) {
        const double thickness_nm = film.layers.front().thickness_nm;
        for (const TableRange& range :
             {TableRange{thickness_nm, thickness_nm, 0.3, 0.3}, TableRange{0.0, 50.0, 0.0, 0.0}})
            for (const glm::mat3& value : bake(film, range).values) ASSERT_TRUE(std::isfinite(largest(value)));
    }
}

}  // namespace
}  // namespace rowland::thin_film
