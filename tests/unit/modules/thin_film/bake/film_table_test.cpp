#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/lighting/lobe_nodes.h"
#include "modules/thin_film/bake/film_table.h"
#include "modules/thin_film/reference/film_reference.h"
#include "tests/support/csv.h"
#include "tests/support/files.h"
#include "tests/support/light.h"

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

namespace {

using rowland::test::Facing;
using rowland::test::random_facings;

FilmTable table_of(const Film& film, const TableRange& range) {
    return bake_table(FilmColour(film, colour::LightSpectra{}), range, table_size(range));
}

/// Relative RMS error over the facings.
double error_under(const lighting::LightSamples& light, const Film& film, double roughness, int facings) {
    const double thickness_nm = film.layers.front().thickness_nm;
    const TableRange range{thickness_nm, thickness_nm, roughness, roughness};
    const FilmTable table = table_of(film, range);
    const RoughReference reference(film, colour::LightSpectra{});
    double off = 0.0;
    double whole = 0.0;
    for (const Facing& facing : random_facings(facings)) {
        const RoughReference::Reflected reflected = reference.reflected(light, facing.n, facing.v, roughness);
        const glm::dvec3 found =
            table.at(glm::dot(facing.n, facing.v), thickness_nm, roughness) * reflected.without_fresnel;
        off += glm::dot(found - reflected.xyz, found - reflected.xyz);
        whole += glm::dot(reflected.xyz, reflected.xyz);
    }
    return std::sqrt(off / whole);
}

const Film kSoapOnGlass{.layers = {{1.33, 400.0}}, .base = std::complex<double>(1.5)};
const Film kBareGlass{.layers = {{1.33, 0.0}}, .base = std::complex<double>(1.5)};
const Film kAnodised{.layers = {{2.4, 110.0}}, .base = std::complex<double>(2.5, 3.3)};

lighting::LightSamples captured(const std::filesystem::path& path) {
    return lighting::merge_samples(lighting::light_samples(lighting::load_probe_image(path, lighting::Mapping::Auto)),
                                   64);
}

TEST(RoughFilm, UnderACapturedProbeIsNearTheSumOverMicrofacets) {
    ROWLAND_TEST_DATA(path, "probes/ennis_probulator.hdr");
    EXPECT_LE(error_under(captured(path), kAnodised, 0.3, 8), 0.03);
}

TEST(RoughFilm, UnderFourCapturedProbesIsNearTheSumOverMicrofacets) {
    for (const char* name :
         {"grace_probe.hdr", "ennis_probulator.hdr", "royal_esplanade_1k.hdr", "blender_sunset.exr"}) {
        ROWLAND_TEST_DATA(path, std::string("probes/") + name);
        const lighting::LightSamples light = captured(path);
        for (const double roughness : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}) {
            const double anodised = error_under(light, kAnodised, roughness, 24);
            const double bare = error_under(light, kBareGlass, roughness, 24);
            const double soap = error_under(light, kSoapOnGlass, roughness, 24);
            // Measured: 0.05 under Ennis at 0.6, at most 0.03 under the others.
            EXPECT_LE(anodised, 0.055) << name << " " << roughness;
            // On glass the split sum itself is off, film or not: lamps at grazing incidence.
            EXPECT_LE(soap, 2.0 * bare) << name << " " << roughness << " bare " << bare;
        }
    }
}

/// The sum over microfacets under light of one colour from all sides gives a column of the exact mean over the lobe.
glm::dmat3 exact_mean(const RoughReference& reference, double cosine, double roughness) {
    constexpr int kDirections = 100000;  // 0.6 degrees apart: a lobe of roughness 0.2 has a hundred
    const glm::dvec3 n(0.0, 0.0, 1.0);
    const glm::dvec3 v(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
    glm::dmat3 mean(0.0);
    for (int colour = 0; colour < 3; ++colour) {
        glm::dvec3 flux(0.0);
        flux[colour] = 1.0;
        lighting::LightSamples light;
        for (int i = 0; i < kDirections; ++i) {  // Fibonacci's
            const double z = (i + 0.5) / kDirections;
            const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
            const double side = std::sqrt(1.0 - z * z);
            light.push_back({side * std::cos(turn), side * std::sin(turn), z}, flux);
        }
        const RoughReference::Reflected reflected = reference.reflected(light, n, v, roughness);
        mean[colour] = reflected.xyz / reflected.without_fresnel[colour];
    }
    return mean;
}

/// What the film adds to the split sum's own error: as drawn, against the same split sum with the exact mean. Relative
/// RMS.
double own_error_under(const lighting::LightSamples& light, const Film& film, const FilmTable& table,
                       double roughness) {
    const RoughReference reference(film, colour::LightSpectra{});
    const double thickness_nm = film.layers.front().thickness_nm;
    double off = 0.0;
    double whole = 0.0;
    for (const Facing& facing : random_facings(8)) {
        const double cosine = glm::dot(facing.n, facing.v);
        const glm::dvec3 lobe = reference.reflected(light, facing.n, facing.v, roughness).without_fresnel;
        const glm::dvec3 exact = exact_mean(reference, cosine, roughness) * lobe;
        const glm::dvec3 difference = table.at(cosine, thickness_nm, roughness) * lobe - exact;
        off += glm::dot(difference, difference);
        whole += glm::dot(exact, exact);
    }
    return std::sqrt(off / whole);
}

TEST(RoughFilm, UnderFourCapturedProbesAddsLittleToTheErrorOfTheSplitSum) {
    for (const Film& film : {kAnodised, kSoapOnGlass}) {
        const FilmTable of_all = table_of(film, {100.0, 400.0, 0.0, 0.6});
        for (const char* name :
             {"grace_probe.hdr", "ennis_probulator.hdr", "royal_esplanade_1k.hdr", "blender_sunset.exr"}) {
            ROWLAND_TEST_DATA(path, std::string("probes/") + name);
            const lighting::LightSamples light = captured(path);
            for (const double roughness : {0.2, 0.4, 0.6}) {
                const double thickness_nm = film.layers.front().thickness_nm;
                const FilmTable of_one = table_of(film, {thickness_nm, thickness_nm, roughness, roughness});
                const double one = own_error_under(light, film, of_one, roughness);
                const double all = own_error_under(light, film, of_all, roughness);
                EXPECT_LE(one, 0.01) << name << " " << roughness;
                EXPECT_LE(all, 0.01) << name << " " << roughness;
            }
        }
    }
}

}  // namespace

}  // namespace rowland::thin_film
