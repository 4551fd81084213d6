#include "engine/lighting/sh_light.h"
#include "engine/math/spherical_harmonics.h"
#include "tests/support/csv.h"
#include "tests/support/files.h"
#include "tests/unit/engine/lighting/made_probes.h"

namespace rowland::lighting {

namespace {

using std::numbers::pi;

/// The definition: Σ L Y ΔΩ over texel centres.
std::vector<glm::dvec3> brute_force(const ProbeImage& probe, int bands) {
    std::vector<double> y(static_cast<std::size_t>(math::sh_count(bands)));
    std::vector<glm::dvec3> sum(y.size(), glm::dvec3(0.0));
    double total = 0;
    for (int row = 0; row < probe.image().height; ++row)
        for (int column = 0; column < probe.image().width; ++column) {
            const double solid_angle = probe.solid_angle(column, row);
            if (solid_angle == 0) continue;
            total += solid_angle;
            math::evaluate_sh(probe.direction(column + 0.5, row + 0.5), bands, y);
            for (std::size_t i = 0; i < y.size(); ++i)
                sum[i] += solid_angle * y[i] * glm::dvec3(probe.image().at(column, row));
        }
    for (glm::dvec3& c : sum) c *= 4 * pi / total;
    return sum;
}

/// Light without any symmetry.
glm::dvec3 lopsided(const glm::dvec3& d) {
    return {std::exp(2 * d.x - d.y), 1 + 0.5 * d.z + 0.3 * d.x * d.y, d.y > 0.2 ? 3.0 : 0.1};
}

TEST(Project, AgreesWithTheDefinitionAt32Bands) {
    for (const Mapping mapping : test::kMappings)
        for (const int height : {31, 48}) {
            const ProbeImage probe = test::made_probe(mapping, height, lopsided);
            const ShLight light = project(probe, 32);
            const auto expected = brute_force(probe, 32);
            ASSERT_EQ(light.coefficients.size(), expected.size());
            for (std::size_t i = 0; i < expected.size(); ++i)
                // Rounding of a few thousand texels of size up to 8.
                EXPECT_LT(glm::length(light.coefficients[i] - expected[i]), 1e-11) << i;
        }
}

TEST(Project, EveryWidthAgreesWithTheDefinition) {
    for (int width = 1; width <= 13; ++width) {  // rows are folded about their middle column, if there is one
        image::Image image{width, 5, {}};
        for (int i = 0; i < 5 * width; ++i) image.texels.emplace_back(1 + i % 7, i % 3, 0.1F * static_cast<float>(i));
        const ProbeImage probe(image, Mapping::Equirectangular);
        const ShLight light = project(probe, 9);
        const auto expected = brute_force(probe, 9);
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_LT(glm::length(light.coefficients[i] - expected[i]), 1e-12) << width << " columns, " << i;
    }
}

TEST(Project, WhiteFurnaceHasOnlyBandZero) {
    for (const Mapping mapping : test::kMappings) {
        const ShLight light = project(test::constant_probe(mapping, 256), 8);
        EXPECT_NEAR(light.coefficients[0].x, std::sqrt(4 * pi), 1e-12);
        for (std::size_t i = 1; i < light.coefficients.size(); ++i)
            // Midpoint sampling of bands up to 7 with texels of π/256: their squares over 24, times a few l².
            EXPECT_LT(glm::length(light.coefficients[i]), 2e-3) << i;
    }
}

TEST(Project, GraceAndBeachAgreeWithPublishedCoefficients) {
    ROWLAND_TEST_DATA(table_path, "data/facts/rh_orangebook_sh_lighting_coefficients.csv");
    const test::Csv table = test::read_csv(table_path);
    const struct {
        const char* file;
        double scale;
    } probes[] = {{"grace_probe.hdr", 3.20}, {"beach_probe.hdr", 2.50}};
    for (const auto& expected : probes) {
        ROWLAND_TEST_DATA(path, std::string("probes/") + expected.file);
        const ShLight light = project({image::load_image(path), Mapping::Angular, expected.file}, 3);
        struct Pair {
            double ours, published;
        };
        std::vector<Pair> pairs;
        for (std::size_t row = 0; row < table.rows.size(); ++row) {
            if (table.text(row, "debevec_file") != expected.file) continue;
            const int l = table.integer(row, "l");
            const int m = table.integer(row, "m");
            const double sign = (l + m) % 2 == 0 ? 1 : -1;  // their z axis is our −z
            const glm::dvec3 c = light.coefficients[static_cast<std::size_t>(math::sh_index(l, m))];
            const char* columns[] = {"R", "G", "B"};
            for (int k = 0; k < 3; ++k) pairs.push_back({sign * c[k], table.number(row, columns[k])});
        }
        ASSERT_EQ(pairs.size(), 27u);
        double dot = 0;
        double square = 0;
        for (const Pair& p : pairs) {
            dot += p.ours * p.published;
            square += p.published * p.published;
        }
        const double scale = dot / square;
        EXPECT_NEAR(scale, expected.scale, 0.005) << expected.file;  // PHYSICS §9 prints three digits
        for (const Pair& p : pairs) EXPECT_NEAR(p.ours / scale, p.published, 0.005) << expected.file;
    }
}

}  // namespace

}  // namespace rowland::lighting
